//! The records of bidirectional paths.
use crate::integrator::queue::record;

record! {
    /// A light sample whose weight is not known before its ray has met the light.
    DirectSample {
        o: V,
        d: V,
        /// Its contribution if it is visible, without its weight.
        radiance: V,
        target: U,
        slot: U,
        /// Pdf of the sample, and that of its direction by the BSDF.
        pdf: F,
        bsdf_pdf: F,
        /// The [`super::partial`] sum for P = cos θ: the light density is missing.
        partial: F,
        /// Media around the way.
        media: U,
    }
}

record! {
    /// A vertex of a light path that is connected to the camera, if nothing lies between.
    CameraRay {
        o: V,
        d: V,
        distance: F,
        slot: U,
        /// Where it arrives in the image.
        x: F,
        y: F,
        light: V,
    }
}

record! {
    /// A vertex of a camera path that is connected with one of a light path.
    Connection {
        o: V,
        /// Unit direction to the vertex of the light.
        d: V,
        distance: F,
        /// Cosine at the vertex of the camera.
        cos: F,
        /// Throughput of the camera path times f cos θ.
        light: V,
        /// Pdf of the direction.
        pdf: F,
        /// The [`super::partial`] sum for P = 1.
        partial: F,
        slot: U,
        /// Index of the vertex of the light.
        vertex: U,
    }
}
