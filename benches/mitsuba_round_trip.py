#!/usr/bin/env python3
"""Compares Mitsuba with Noisefall on the shipped scenes, written as XML by `noisefall convert`.

    mitsuba_round_trip.py --bin NOISEFALL [--size 96x72] [--spp 64] [--repeats 8] [SCENE.toml ...]

Each scene is rendered by both programs with several seeds. The images are averaged over blocks of 8 x 8 pixels. The z-score of a block
and channel is the difference of its means over its standard error, both from the repeats. A scene agrees if the mean of the image is
within 4 standard errors, and not more than 1 % of the blocks are beyond 4. Scenes with remarks of the writer are listed with them: they
may differ by as much as the remarks say.

Needs the Python modules mitsuba and numpy. Without them, the script says so and compares nothing.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import mitsuba
    import numpy as np
except ImportError as missing:
    print(f"nothing is compared: the Python module {missing.name} is not installed")
    sys.exit(0)

BLOCK = 8
LIMIT = 4.0
MOST_BEYOND = 0.01


def blocks(image):
    """Means of blocks of pixels, without the pixels that fill no block."""
    rows, columns = (side // BLOCK for side in image.shape[:2])
    image = image[: rows * BLOCK, : columns * BLOCK, :3]
    return image.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))


def read(path):
    """The radiance of an EXR file, without its other layers."""
    bitmap = mitsuba.Bitmap(str(path))
    names = [channel.name for channel in bitmap.struct_()]
    return np.array(bitmap).astype(np.float64)[:, :, [names.index(channel) for channel in "RGB"]]


def by_mitsuba(xml, arguments):
    width, height = arguments.size
    text = re.sub(r'name="width" value="\d+"', f'name="width" value="{width}"', xml.read_text())
    text = re.sub(r'name="height" value="\d+"', f'name="height" value="{height}"', text)
    xml.write_text(text)
    scene = mitsuba.load_file(str(xml))
    for seed in range(arguments.repeats):
        yield blocks(np.array(mitsuba.render(scene, spp=arguments.spp, seed=seed)))


def by_noisefall(toml, folder, arguments):
    image = folder / "image.exr"
    size = "x".join(map(str, arguments.size))
    for seed in range(arguments.repeats):
        command = [arguments.bin, "render", toml, "-o", image, "--spp", arguments.spp, "--size", size, "--seed", seed]
        subprocess.run([str(word) for word in command], check=True, capture_output=True)
        yield blocks(read(image))


def z_scores(a, b):
    """Of the difference of the means of two lists of arrays."""
    a, b = np.array(list(a)), np.array(list(b))
    error = np.sqrt(a.var(axis=0, ddof=1) / len(a) + b.var(axis=0, ddof=1) / len(b))
    difference = a.mean(axis=0) - b.mean(axis=0)
    # Where nothing is random, rounding remains.
    error = np.maximum(error, 1e-4 * np.abs(b.mean(axis=0)) + 1e-9)
    return difference / error


def compare(toml, arguments):
    """Renders a scene twice, and returns whether both agree."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        xml = folder / "scene.xml"
        done = subprocess.run([arguments.bin, "convert", str(toml), "-o", str(xml)], capture_output=True, text=True)
        if done.returncode:
            print(f"{toml.stem:24} not written: {done.stderr.strip().splitlines()[0]}", flush=True)
            return False
        remarks = done.stderr.strip().splitlines()[1:]
        theirs = list(by_mitsuba(xml, arguments))
        ours = list(by_noisefall(toml, folder, arguments))
    z = z_scores(theirs, ours)
    of_image = z_scores([image.mean() for image in theirs], [image.mean() for image in ours])
    mean = f"mean {np.mean(theirs) / np.mean(ours):.4f} of ours" if np.any(ours) else "black"
    beyond = np.mean(np.abs(z) > LIMIT)
    agrees = abs(of_image) <= LIMIT and beyond <= MOST_BEYOND
    verdict = "agrees" if agrees else "differs" if not remarks else "differs, with remarks"
    print(f"{toml.stem:24} {mean}, z = {of_image:+.2f}; {100 * beyond:.2f} % of blocks beyond {LIMIT}: {verdict}")
    for remark in remarks:
        print(f"    {remark.strip()}")
    sys.stdout.flush()
    return agrees or bool(remarks)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True, help="the program noisefall")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), default=(96, 72))
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel of each repeat")
    parser.add_argument("--repeats", type=int, default=8)
    parser.add_argument("--variant", default="scalar_rgb", help="of Mitsuba, such as llvm_ad_rgb")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    mitsuba.set_variant(arguments.variant)
    shipped = pathlib.Path(__file__).resolve().parent.parent / "scenes"
    scenes = arguments.scenes or sorted(shipped.glob("*.toml"))
    results = [compare(scene, arguments) for scene in scenes]
    print(f"{sum(results)} of {len(results)} scenes agree, or differ where remarks say so")
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
