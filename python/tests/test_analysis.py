"""Single paths, comparison, validation."""

import noisefall
import numpy as np
import pytest


def test_the_terms_of_a_path_add_up_to_its_sample(furnace):
    size = (16, 16)
    for sample in range(4):
        path = furnace.replay(3, 5, sample, size=size)
        assert np.allclose(path.radiance, furnace.samples(3, 5, 1, first=sample, size=size)[0])
        rows = path.table()
        assert len(rows) == len(path.vertices) > 0
        assert len({tuple(row) for row in rows}) == 1 and {"bounce", "normal.0"} <= set(rows[0])
    assert str(path).startswith("pixel") or "L" in str(path)


def test_the_mean_of_samples_is_the_pixel(box):
    size = (24, 24)
    image = box.render(spp=32, size=size, reuse="off")
    samples = box.samples(7, 9, 32, size=size, reuse="off")
    assert samples.shape == (32, 3)
    assert np.allclose(samples.mean(axis=0), image.radiance[9, 7], rtol=1e-5)


def test_a_pixel_outside_is_refused(box):
    with pytest.raises(ValueError, match="pixel 24,0 lies outside the image of 24 × 24"):
        box.replay(24, 0, size=(24, 24))


def test_errors_are_those_of_their_formulas(box):
    a, b = (box.render(spp=spp, size=(40, 40), seed=spp) for spp in (4, 64))
    comparison = noisefall.compare(a, b)
    x, r = a.radiance.astype(float), b.radiance.astype(float)
    assert np.isclose(comparison.rmse, np.sqrt(np.mean((x - r) ** 2)))
    assert np.isclose(comparison.rel_mse, np.mean((x - r) ** 2 / (r**2 + 0.01 * np.mean(r**2))))
    assert np.isclose(comparison.bias, np.mean(x - r))
    assert comparison.bias_standard_error > 0 and abs(comparison.bias_in_standard_errors) < 5 and comparison.upper_bound
    of_arrays = noisefall.compare(a.radiance, b.radiance)
    assert of_arrays.rmse == comparison.rmse and of_arrays.bias_standard_error is None
    assert noisefall.compare(a, b, floor=1.0).floor == "1"


def test_images_of_different_sizes_are_not_compared(box):
    a, b = (box.render(spp=1, size=size) for size in ((8, 8), (9, 8)))
    with pytest.raises(noisefall.RenderError, match="the images differ in size: a is 8 × 8, b is 9 × 8"):
        a.compare(b)
    with pytest.raises(noisefall.RenderError, match="pixel 1,0 is not a finite number"):
        noisefall.compare(np.array([[[0, 0, 0], [np.nan, 0, 0]]]), np.zeros((1, 2, 3)))


def test_a_validation_reports_its_sections_and_can_be_stopped():
    seen = []

    def watch(number, title, holds):
        seen.append((number, holds))
        return number < 2

    report = noisefall.validate(callback=watch)
    assert seen == [(1, True), (2, True)]
    assert report.holds and len(report.sections) == 2
    assert all(statement.holds for section in report.sections for statement in section.statements)
