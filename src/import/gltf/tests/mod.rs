//! glTF files that are made in the tests.
