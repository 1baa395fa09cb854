"""A short film of a run, as an animated PNG: every instant of fields.h5, solid fraction and free surface."""

import io

import numpy as np
from PIL import Image, ImageDraw
from report.results import snapshots
from report.style import plt

WIDTH = 480  # pixels of the tank
MARGIN = 16  # for the time, above the picture
LEAST_FRAMES = 5


def film(entry):
    """Bytes of the animation; None for too few instants, or a tank that is too narrow to show."""
    scene = entry["scene"]
    if scene["tank"][1] > 2 * scene["tank"][0]:
        return None
    frames = [frame(time, f_s, alpha, scene) for time, f_s, alpha, _ in snapshots(entry)]
    if len(frames) < LEAST_FRAMES:
        return None
    held = [400] * (len(frames) - 1) + [2000]
    written = io.BytesIO()
    frames[0].save(written, format="PNG", save_all=True, append_images=frames[1:], duration=held, loop=0)
    return written.getvalue()


def frame(time, f_s, alpha, scene):
    """One picture, y up; water tinted, grains by their solid fraction, the surface where alpha = 0.5."""
    scale = max(1, round(WIDTH / f_s.shape[1]))
    grains = plt.get_cmap("YlOrBr")(np.clip(f_s / 0.63, 0, 1))[..., :3]
    around = np.where((alpha > 0.5)[..., None], (0.84, 0.91, 0.97), (1.0, 1.0, 1.0))
    share = np.clip(f_s / 0.05, 0, 1)[..., None]
    colours = share * grains + (1 - share) * around
    colours[surface(alpha)] = (0.1, 0.1, 0.1)
    pixels = (255 * colours[::-1]).astype(np.uint8).repeat(scale, axis=0).repeat(scale, axis=1)
    image = Image.new("RGB", (pixels.shape[1], pixels.shape[0] + MARGIN), "white")
    image.paste(Image.fromarray(pixels), (0, MARGIN))
    scaled = scene["time_unit"] != 1.0
    label = f"T = {abs(time) / scene['time_unit']:.3g}" if scaled else f"t = {abs(time):.3g} s"
    ImageDraw.Draw(image).text((4, 2), label, fill="black")
    return image


def surface(alpha):
    """Cells with alpha above 0.5 that have a cell below 0.5 on top."""
    wet = alpha > 0.5
    above = np.zeros_like(wet)
    above[:-1] = ~wet[1:]
    return wet & above
