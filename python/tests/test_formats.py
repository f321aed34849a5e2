"""The output of the program, by an independent implementation of JSON Schema."""

import json
import shutil
import subprocess

import jsonschema
import noisefall
import pytest
from conftest import SCENES

SCHEMA = json.loads((SCENES.parent / "docs" / "figures.schema.json").read_text())


@pytest.fixture(scope="session")
def program(tmp_path_factory):
    """Runs a command, and returns the last line of its output as JSON."""
    path = shutil.which("noisefall")
    if path is None:
        pytest.skip("the wheel was built without the program")
    folder = tmp_path_factory.mktemp("program")

    def run(*arguments):
        done = subprocess.run([path, *arguments], cwd=folder, check=True, capture_output=True, text=True)
        return json.loads(done.stdout.splitlines()[-1])

    return run


def validator(part):
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    return jsonschema.Draft202012Validator({"$ref": f"#/$defs/{part}", "$defs": SCHEMA["$defs"]})


def test_images_and_comparisons_follow_the_schema(program):
    small = ["--size", "16x16", "--json"]
    for name, options in [("furnace", ["--spp", "2"]), ("sky_lit", ["--time", "0.05"]), ("cornell_box", ["--spp", "1"])]:
        validator("render").validate(program("render", name, "-o", f"{name}.exr", *options, *small))
    validator("compare").validate(program("compare", "furnace.exr", "cornell_box.exr", "--json"))


@pytest.mark.parametrize("name", noisefall.scenes())
def test_paths_follow_the_schema(program, name):
    check = validator("replay")
    for sample in range(2):
        for reuse in ["suffixes", "off"]:
            options = ["--size", "32x32", "--sample", str(sample), "--reuse", reuse, "--json"]
            check.validate(program("render", name, "--pixel", "16,20", *options))


def test_a_validation_follows_the_schema():
    report = json.loads(noisefall._noisefall.validate(True, 0, lambda number, title, holds: number < 4))
    validator("validation").validate(report)


def test_undescribed_figures_are_refused():
    assert not validator("replay").is_valid({"radiance": [0, 0, 0], "alone": None, "shared": None, "vertices": [], "end": "bored"})


@pytest.mark.parametrize("name", noisefall.scenes())
def test_scenes_follow_their_schema(name):
    import tomllib

    check = jsonschema.Draft202012Validator(noisefall.schema())
    tree = tomllib.loads((SCENES / f"{name}.toml").read_text())
    check.validate(tree)
    assert not check.is_valid({**tree, "cameras": tree["camera"]})
