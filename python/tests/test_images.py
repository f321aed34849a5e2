"""Rendering: targets, callbacks, arrays, files."""

import _thread
import subprocess
import shutil
import threading
import time

import noisefall
import numpy as np
import pytest

SMALL = (48, 32)


def test_a_furnace_converges_to_its_truth(furnace):
    image = furnace.render(spp=64, size=SMALL)
    assert image.radiance.shape == (32, 48, 3) and image.radiance.dtype == np.float32
    assert abs(image.radiance.mean() - 2.0) < 0.01
    assert (image.spp, image.stopped_by) == (64, "samples")
    assert image.figures["rel_mse"] < 0.001 and image.figures["biased"] is None


def test_arrays_view_the_memory_of_the_image(box):
    image = box.render(spp=2, size=SMALL)
    a, b = (np.asarray(image._native.radiance) for _ in range(2))
    assert np.shares_memory(a, b) and not a.flags.owndata and not a.flags.writeable
    with pytest.raises(ValueError):
        a[0, 0, 0] = 1.0
    # The view keeps the memory when everything else is gone.
    kept, copy = image.radiance, image.radiance.copy()
    del image, a, b
    box.render(spp=2, size=SMALL)
    assert np.array_equal(kept, copy)


def test_equal_seeds_give_equal_bits_for_any_number_of_threads(box):
    settings = {"spp": 4, "size": SMALL, "seed": 7}
    one, two = (box.render(threads=threads, **settings).radiance for threads in (1, 3))
    assert np.array_equal(one, two)
    assert not np.array_equal(one, box.render(**{**settings, "seed": 8}).radiance)


def test_the_variance_predicts_the_scatter_of_repeats(box):
    repeats = [box.render(spp=16, size=SMALL, seed=seed, sampler="independent", reuse="off") for seed in range(24)]
    scatter = np.var([image.radiance for image in repeats], axis=0, ddof=1)
    predicted = np.mean([image.variance for image in repeats], axis=0)
    assert predicted.shape == (32, 48, 3)
    assert abs(predicted.mean() / scatter.mean() - 1.0) < 0.25
    first = box.render(spp=1, size=SMALL)
    assert first.variance is None and np.isnan(first.standard_error).all() and first.noise is None


def test_callbacks_see_the_render_grow_and_stop_it(box):
    seen = []
    image = box.render(spp=64, size=SMALL, stops=[1, 4, 16, 100], callback=lambda image: seen.append(image.spp))
    assert seen == [1, 4, 16, 64] and image.spp == 64
    whole = box.render(spp=64, size=SMALL)
    assert np.array_equal(whole.radiance, image.radiance)
    stopped = box.render(spp=64, size=SMALL, stops=[1, 4, 16], callback=lambda image: image.spp < 4)
    assert (stopped.spp, stopped.stopped_by) == (4, "callback")
    endless = box.render(spp=10**9, size=(256, 256), callback=lambda image: image.spp < 2)
    assert endless.stopped_by == "callback" and 2 <= endless.spp < 10**9


def test_an_exception_of_a_callback_ends_the_render(box):
    def fail(image):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        box.render(spp=10**9, size=SMALL, callback=fail)


def test_ctrl_c_stops_a_render(box):
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        box.render(spp=10**9, size=(512, 512))
    assert time.monotonic() - start < 10.0


def test_other_threads_run_meanwhile(box):
    counted, done = [0], threading.Event()

    def count():
        while not done.wait(0.001):
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    box.render(time=0.5, size=(128, 128))
    done.set()
    thread.join()
    assert counted[0] > 20


def test_time_and_noise_are_targets(box):
    assert box.render(time=0.05, size=SMALL).stopped_by == "time"
    image = box.render(noise=0.2, size=SMALL)
    assert image.stopped_by == "noise" and image.noise <= 0.2
    assert box.render(spp=1, noise=0.001, size=SMALL).stopped_by == "samples"


def test_bounces_add_up_to_the_image(box):
    image = box.render(spp=64, size=SMALL, bounces=True)
    total = np.sum(image.bounces, axis=0)
    assert total.shape == image.radiance.shape
    assert abs(total.mean() / image.radiance.mean() - 1.0) < 0.05
    assert box.render(spp=1, size=SMALL).bounces is None
    stopped = box.render(spp=10**9, size=SMALL, bounces=True, stops=[4], callback=lambda image: False)
    assert stopped.spp == 4 and len(stopped.bounces) == len(image.bounces)


def test_adaptive_sampling_counts_its_samples(box):
    image = noisefall.load("veach_plates").render(spp=32, size=(128, 96), adaptive=True)
    assert image.counts.shape == (96, 128) and image.counts.dtype == np.uint32
    assert image.figures["adapts"] == bool(np.ptp(image.counts))
    uniform = box.render(spp=3, size=SMALL)
    assert (uniform.counts == 3).all()


def test_files_carry_their_scene_and_are_those_of_the_program(box, tmp_path):
    image = box.render(spp=4, size=SMALL, seed=3)
    image.save(tmp_path / "a.exr")
    image.save(tmp_path / "a.png", exposure=1.0, tone="agx")
    again = noisefall.load(tmp_path / "a.exr")
    assert again.title == box.title and again.size == SMALL
    assert image.compare(tmp_path / "a.exr").rmse == 0.0
    program = shutil.which("noisefall")
    if program is None:
        pytest.skip("the wheel was built without the program")
    options = ["--spp", "4", "--size", "48x32", "--seed", "3"]
    subprocess.run([program, "render", "cornell_box", "-o", tmp_path / "b.exr", *options], check=True)
    assert image.compare(tmp_path / "b.exr").rmse == 0.0


def test_display_codes_are_those_of_the_file(furnace):
    codes = furnace.render(spp=1, size=SMALL, estimator="path", directions="cosine", max_bounces=0).srgb()
    assert codes.shape == (32, 48, 3) and codes.dtype == np.uint8 and (codes == 255).all()


def test_wrong_arguments_are_value_errors_that_list_the_valid_ones(box, tmp_path):
    for settings, words in [
        ({"estimator": "bdpt"}, "path, light, mis"),
        ({"roulette": "x"}, "throughput"),
        ({"max_bounces": "many"}, "`none`"),
        ({"spp": 0}, "1 or more"),
        ({"time": -1.0}, "above 0"),
        ({"size": (0, 8)}, "resolution"),
        ({"spp": -1}, "expected u32"),
    ]:
        with pytest.raises(ValueError, match=words):
            box.render(**settings)
    with pytest.raises(noisefall.RenderError, match=r"must end in \.png"):
        box.render(spp=1, size=(8, 8)).save(tmp_path / "a.jpg")
