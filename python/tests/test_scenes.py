"""Scenes: files, texts and trees of values."""

import tomllib
from pathlib import Path

import noisefall
import numpy as np
import pytest
from noisefall import description as d
from noisefall import stubs

from conftest import SCENES


def ball(**more):
    """A tree of values with a lit ball."""
    return {
        "camera": {"eye": [0, 0, 4], "look_at": [0, 0, 0], "fov": 40.0, "resolution": [32, 32]},
        "materials": {"white": {"lambertian": {"albedo": 0.7}}},
        "background": {"radiance": 1.0},
        "objects": [{"shape": {"sphere": {"center": [0, 0, 0], "radius": 1.0}}, "material": "white"}],
        **more,
    }


def test_every_scene_of_the_program_can_be_named():
    names = noisefall.scenes()
    assert names == sorted(path.stem for path in SCENES.glob("*.toml"))
    scene = noisefall.load("sky_lit")
    assert scene.text == (SCENES / "sky_lit.toml").read_text()
    assert scene.object_count > 0 and scene.size == noisefall.load(SCENES / "sky_lit.toml").size


def test_a_tree_of_dicts_is_the_scene_of_its_text():
    built = noisefall.build(ball(title="A ball"))
    parsed = noisefall.parse(built.text)
    assert built.title == parsed.title == "A ball"
    a, b = (scene.render(spp=4).radiance for scene in (built, parsed))
    assert np.array_equal(a, b)


def test_dataclasses_and_dicts_say_the_same():
    described = d.Description(
        camera=d.Camera(eye=[0, 0, 4], look_at=[0, 0, 0], fov=40.0, resolution=[32, 32]),
        materials={"white": d.Material(lambertian=d.Lambertian(albedo=np.float64(0.7)))},
        background=d.Background(radiance=1.0),
        objects=[d.Object(shape=d.Shape(sphere=d.Sphere(center=[0, 0, 0], radius=1.0)), material="white")],
    )
    a, b = (noisefall.build(tree).render(spp=2).radiance for tree in (described, ball()))
    assert np.array_equal(a, b)


@pytest.mark.parametrize("name", noisefall.scenes())
def test_the_dataclasses_have_every_key_of_the_scenes(name):
    tree = tomllib.loads((SCENES / f"{name}.toml").read_text())
    keys = {field for table in d.__all__ for field in getattr(getattr(d, table), "__dataclass_fields__", {})}
    names = {"materials", "textures"}

    def check(value, is_named=False):
        if isinstance(value, dict):
            assert is_named or keys >= set(value)
            for key, item in value.items():
                check(item, key in names and not is_named)
        elif isinstance(value, list):
            for item in value:
                check(item)

    # A reference to a texture is a dict with one key, which is no table.
    keys.add("texture")
    check(tree)


def test_a_wrong_scene_is_an_error_with_the_words_of_the_program():
    with pytest.raises(noisefall.SceneError) as wrong:
        noisefall.parse((SCENES / "furnace.toml").read_text().replace("albedo", "albido"), "a/room.toml")
    assert "did you mean `albedo`" in str(wrong.value) and "a/room.toml:" in str(wrong.value)
    with pytest.raises(noisefall.NoisefallError, match="there is no such file"):
        noisefall.load("no_such_scene.toml")
    with pytest.raises(noisefall.SceneError, match="radius"):
        noisefall.build(ball(objects=[{"shape": {"sphere": {"center": [0, 0, 0], "radius": -1.0}}}]))
    with pytest.raises(TypeError):
        d.Sphere(radios=1.0)
    with pytest.raises(TypeError, match="cannot hold"):
        noisefall.build(ball(notes=object()))


def test_warnings_are_those_of_the_check():
    scene = noisefall.build(ball(objects=[{"shape": {"sphere": {"center": [0, 0, 0], "radius": 1.0}}}]))
    assert any("material" in warning for warning in scene.warnings)
    assert scene.remarks == []


def test_paths_of_a_tree_are_relative_to_its_folder(tmp_path):
    tree = tomllib.loads((SCENES / "sky_lit.toml").read_text())
    assert noisefall.build(tree, SCENES).object_count > 0
    with pytest.raises(noisefall.SceneError, match="sky.exr"):
        noisefall.build(tree, tmp_path)


def test_the_types_for_editors_are_those_of_the_declarations():
    stored = Path(__file__).parents[1] / "noisefall" / "description.pyi"
    assert stored.read_text() == stubs.stubs(), "run: python -m noisefall.stubs > noisefall/description.pyi"


def test_the_schema_is_that_of_scene_files():
    assert noisefall.schema()["title"] == "Noisefall scene"
    assert d.Sphere.__doc__.startswith("A sphere") and "radius: " in d.Sphere.__doc__
