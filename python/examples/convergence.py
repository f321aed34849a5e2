"""Draws the error of two estimators against the number of samples.

    python convergence.py [OUT.png]

The scene is the furnace, in which the radiance is exactly 2, so that the error is known. Independent samples have a relMSE of σ²/N;
Sobol samples fall faster.
"""

import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import noisefall
import numpy as np

SPP = [2**power for power in range(11)]
SIZE = (128, 128)
SAMPLERS = ["independent", "stratified", "sobol"]


def curve(scene: noisefall.Scene, sampler: str) -> list[float]:
    """relMSE at each number of samples. One render makes the whole curve."""
    errors: list[float] = []
    scene.render(
        spp=SPP[-1],
        size=SIZE,
        sampler=sampler,
        reuse="off",
        stops=SPP,
        callback=lambda image: errors.append(image.figures["rel_mse"]),
    )
    return errors


def main() -> None:
    out = sys.argv[1] if len(sys.argv) > 1 else "convergence.png"
    scene = noisefall.load("furnace")
    _, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for sampler in SAMPLERS:
        errors = curve(scene, sampler)
        slope = np.polyfit(np.log(SPP), np.log(errors), 1)[0]
        print(f"{sampler:<12} relMSE {errors[0]:.2e} at 1 spp, {errors[-1]:.2e} at {SPP[-1]} spp, slope {slope:+.2f}")
        axes.loglog(SPP, errors, "o-", label=f"{sampler}, slope {slope:.2f}")
    axes.set(xlabel="samples per pixel", ylabel="relMSE", title=scene.title)
    axes.grid(which="both", alpha=0.3)
    axes.legend()
    plt.savefig(out, dpi=150)
    print(out)


if __name__ == "__main__":
    main()
