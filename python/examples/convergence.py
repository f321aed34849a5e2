# %% [markdown]
# # Convergence
#
# Draws the error of three samplers against the number of samples. Run it as a script, `python convergence.py [OUT.png]`, or cell by
# cell in an editor that knows `# %%`.

# %%
import sys

import matplotlib

if "ipykernel" not in sys.modules:
    matplotlib.use("Agg")

import matplotlib.pyplot as plt
import noisefall
import numpy as np

# %% [markdown]
# Inside the furnace, a closed sphere that emits 1 and reflects half, the radiance is exactly 2. So the error of an image is known.

# %%
scene = noisefall.load("furnace")
print(scene, "-", scene.notes)

# %% [markdown]
# One render makes a whole curve: it stops at each number of samples, and continues with the samples that it has.

# %%
SPP = [2**power for power in range(11)]


def curve(sampler: str) -> list[float]:
    """relMSE at each number of samples."""
    errors: list[float] = []
    scene.render(
        spp=SPP[-1],
        size=(128, 128),
        sampler=sampler,
        reuse="off",
        stops=SPP,
        callback=lambda image: errors.append(image.figures["rel_mse"]),
    )
    return errors


curves = {sampler: curve(sampler) for sampler in ["independent", "stratified", "sobol"]}

# %% [markdown]
# The relMSE of independent samples is σ²/N, a slope of -1. That of stratified and Sobol samples falls faster.

# %%
figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
for sampler, errors in curves.items():
    slope = np.polyfit(np.log(SPP), np.log(errors), 1)[0]
    print(f"{sampler:<12} relMSE {errors[0]:.2e} at 1 spp, {errors[-1]:.2e} at {SPP[-1]} spp, slope {slope:+.2f}")
    axes.loglog(SPP, errors, "o-", label=f"{sampler}, slope {slope:.2f}")
axes.set(xlabel="samples per pixel", ylabel="relMSE", title=scene.title)
axes.grid(which="both", alpha=0.3)
axes.legend()

out = sys.argv[1] if len(sys.argv) > 1 and sys.argv[1].endswith((".png", ".svg", ".pdf")) else "convergence.png"
figure.savefig(out, dpi=150)
print(out)
