"""A short film of a run, as an animated PNG and, where ffmpeg is installed, as mp4: every instant of fields.h5, shown for as
long as its share of the run's time; solid fraction and free surface, the beads of a record below it."""

import io
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.ticker import MaxNLocator
from PIL import Image, ImageDraw

from granvof_files import bytes_of, write_whole
from report.results import snapshots
from report.snapshots import label_of_time
from report.style import plt

WIDTH = 480  # pixels of the tank
LEFT, BELOW, ABOVE = 40, 26, 28  # pixels around a tank: for the numbers of y and x, and for the time
LEAST_FRAMES = 5
LASTS, HOLDS_END, SHORTEST = 6000, 2000, 20  # ms: of the film without its last frame, of that frame, and the least of any
RATE = 25  # frames a second of the mp4


@dataclass
class Film:
    frames: list  # pictures, all of a size
    held: list  # ms that each is shown

    def apng(self):
        written = io.BytesIO()
        self.frames[0].save(written, format="PNG", save_all=True, append_images=self.frames[1:], duration=self.held, loop=0)
        return written.getvalue()

    def write(self, path):
        """Writes PATH.apng and, where it can be made, PATH.mp4; gives back the bytes of the first."""
        path.parent.mkdir(parents=True, exist_ok=True)
        data, other = self.apng(), self.mp4()
        write_whole(path.with_name(path.name + ".apng"), data)
        if other is not None:
            write_whole(path.with_name(path.name + ".mp4"), other)
        return data

    def mp4(self):
        """Bytes; None where there is no ffmpeg, or it has no encoder of H.264."""
        if shutil.which("ffmpeg") is None:
            return None
        wide, high = (2 * (side // 2) for side in self.frames[0].size)  # H.264 takes even numbers alone
        with tempfile.TemporaryDirectory() as directory:
            path = Path(directory) / "film.mp4"
            pixels = b"".join(frame.convert("RGB").crop((0, 0, wide, high)).tobytes() * max(1, round(RATE * held / 1000))
                              for frame, held in zip(self.frames, self.held))
            ended = subprocess.run(["ffmpeg", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{wide}x{high}",
                                    "-r", str(RATE), "-i", "-", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart", path],
                                   input=pixels, stderr=subprocess.DEVNULL)
            return bytes_of(path) if ended.returncode == 0 and path.exists() else None


def film(entry, record=None, name=""):
    """The film; None for too few instants, or a tank that is too narrow to show. `record`: an entry like that of the run, called
    `name`, shown below it, each of its instants until its next."""
    scene = entry["scene"]
    if scene["tank"][1] > 2 * scene["tank"][0]:
        return None
    shots = [shot[:3] for shot in snapshots(entry)]
    if len(shots) < LEAST_FRAMES:
        return None
    recorded = [shot[:3] for shot in snapshots(record)] if record else []
    frames = []
    for time, f_s, alpha in shots:
        panels = [(label_of_time(time, scene), f_s, alpha)]
        if recorded:
            then, solid, liquid = until(recorded, time, scene)
            panels.append((f"{name}, {label_of_time(then, scene)}", solid, liquid))
        frames.append(frame(panels, scene))
    return Film(frames, held_for([time for time, *_ in shots]))


def caption(run, scene, beside):
    return (f"{run}: film, {'mid-plane of the tank' if scene['dimensions'] == 3 else 'the slice'}; each instant is shown for its share "
            f"of the time{', the beads of DEM-VOF below' if beside else ''}; colour: solid fraction, blue: liquid, dark line: alpha = 0.5.")


def until(recorded, time, scene):
    """The last of the record's instants that is not later, but for rounding; its first where all are."""
    return ([shot for shot in recorded if shot[0] <= time + 1e-6 * scene["time_unit"]] or recorded[:1])[-1]


def held_for(times):
    """ms of each instant: until the next, at one pace for the whole film."""
    span = times[-1] - times[0]
    steps = np.diff(times) / span if span > 0 else np.full(len(times) - 1, 1 / (len(times) - 1))
    return [max(SHORTEST, round(LASTS * step)) for step in steps] + [HOLDS_END]


def frame(panels, scene):
    """One picture: panels (label, f_s, alpha) below each other, each with its axes in mm."""
    images = [with_axes(pixels_of(f_s, alpha), label, scene["tank"], last=index + 1 == len(panels))
              for index, (label, f_s, alpha) in enumerate(panels)]
    whole = Image.new("RGB", (max(image.width for image in images), sum(image.height for image in images)), "white")
    top = 0
    for image in images:
        whole.paste(image, (0, top))
        top += image.height
    return whole


def pixels_of(f_s, alpha):
    """The tank, y up; water tinted, grains by their solid fraction, the surface where alpha = 0.5."""
    grains = plt.get_cmap("YlOrBr")(np.clip(f_s / 0.63, 0, 1))[..., :3]
    around = np.where((alpha > 0.5)[..., None], (0.84, 0.91, 0.97), (1.0, 1.0, 1.0))
    share = np.clip(f_s / 0.05, 0, 1)[..., None]
    colours = share * grains + (1 - share) * around
    colours[surface(alpha)] = (0.1, 0.1, 0.1)
    scale = max(1, round(WIDTH / f_s.shape[1]))
    return Image.fromarray((255 * colours[::-1]).astype(np.uint8).repeat(scale, axis=0).repeat(scale, axis=1))


def with_axes(pixels, label, tank, last):
    """The picture of a tank with its label above and the numbers of its axes; those of x below the last one alone."""
    image = Image.new("RGB", (pixels.width + LEFT + 8, pixels.height + ABOVE + (BELOW if last else 6)), "white")
    draw = ImageDraw.Draw(image)
    left, top, bottom = LEFT, ABOVE, ABOVE + pixels.height
    image.paste(pixels, (left, top))
    draw.text((left + 8, 4), label, fill="black")
    for value in ticks(1e3 * tank[1], pixels.height // 30):
        y = bottom - round(pixels.height * value / (1e3 * tank[1]))
        draw.line((left - 4, y, left - 1, y), fill="black")
        text = f"{value:g}"
        draw.text((left - 6 - draw.textlength(text), y - 6), text, fill="black")
    draw.text((2, top - 22), "y [mm]", fill="black")
    if last:
        for value in ticks(1e3 * tank[0], 6):
            x = left + round(pixels.width * value / (1e3 * tank[0]))
            draw.line((x, bottom, x, bottom + 3), fill="black")
            text = f"{value:g}"
            draw.text((min(x - draw.textlength(text) / 2, image.width - draw.textlength(text)), bottom + 5), text, fill="black")
        draw.text((2, bottom + 12), "x [mm]", fill="black")
    return image


def ticks(length, most):
    return [value for value in MaxNLocator(nbins=max(1, min(most, 6))).tick_values(0.0, length) if 0 <= value <= length]


def surface(alpha):
    """Cells with alpha above 0.5 that have a cell below 0.5 on top."""
    wet = alpha > 0.5
    above = np.zeros_like(wet)
    above[:-1] = ~wet[1:]
    return wet & above
