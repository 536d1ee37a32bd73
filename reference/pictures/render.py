"""Renders what `subsurface export --to mitsuba` wrote, with the standard error of every pixel.

    pip install mitsuba numpy
    subsurface export --to mitsuba --scene sphere --light=-0.6,-0.3,-0.7 --ambient 0 --out truth
    python3 reference/pictures/render.py truth --samples 64 --seeds 8 --out sphere.exr

Each channel is a scene of its own, rendered once per seed. The picture is the mean over the seeds, and its standard error
the seeds' standard deviation over the root of their number. `A` is the share of 64 rays that meet an object.
"""

import argparse
import os
import sys
import tempfile

import mitsuba
import numpy

CHANNELS = ("red", "green", "blue")
RAYS_PER_EDGE = 8


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="what `subsurface export` wrote")
    parser.add_argument("--samples", type=int, default=64, help="paths per pixel, channel and seed (default: 64)")
    parser.add_argument("--seeds", type=int, default=8, help="independent pictures, at least 2 (default: 8)")
    parser.add_argument("--out", required=True, metavar="FILE.exr", help="R, G, B, stderr.R, stderr.G, stderr.B and A")
    parser.add_argument("--note", default="", help="a text for the file's header: how the scene was exported")
    arguments = parser.parse_args()
    if arguments.samples < 1 or arguments.seeds < 2:
        parser.error("give at least one sample and two seeds")
    files = [os.path.join(arguments.folder, f"{name}.xml") for name in CHANNELS]
    missing = [file for file in files if not os.path.isfile(file)]
    if missing:
        parser.error(f"there is no {missing[0]}: write it with `subsurface export --to mitsuba --out {arguments.folder}`")

    mitsuba.set_variant("scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    planes = {}
    for name, letter, file in zip(CHANNELS, "RGB", files):
        scene = mitsuba.load_file(file, samples=str(arguments.samples))
        pictures = []
        for seed in range(arguments.seeds):
            print(f"\r{name}: {seed + 1} of {arguments.seeds}", end="", file=sys.stderr, flush=True)
            # Seeds of different channels must differ too: equal noise would look like a colour.
            picture = mitsuba.render(scene, seed=1000 * CHANNELS.index(name) + seed)
            pictures.append(numpy.array(picture, dtype=numpy.float64)[:, :, 0])
        planes[letter] = numpy.mean(pictures, axis=0)
        planes[f"stderr.{letter}"] = numpy.std(pictures, axis=0, ddof=1) / numpy.sqrt(arguments.seeds)
        if name == CHANNELS[0]:
            planes["A"] = coverage(scene, planes[letter].shape)
    print(file=sys.stderr)
    command = f"render.py --samples {arguments.samples} --seeds {arguments.seeds}"
    write(arguments.out, planes, {"command": command, "mitsuba": mitsuba.__version__, "scene": arguments.note})


def coverage(scene, shape):
    """Share of a pixel's rays that meet an object."""
    sensor = scene.sensors()[0]
    height, width = shape
    covered = numpy.zeros(shape)
    steps = (numpy.arange(RAYS_PER_EDGE) + 0.5) / RAYS_PER_EDGE
    for y in range(height):
        for x in range(width):
            for dy in steps:
                for dx in steps:
                    place = mitsuba.Point2f((x + dx) / width, (y + dy) / height)
                    ray, _ = sensor.sample_ray(0.0, 0.5, place, mitsuba.Point2f(0.5, 0.5))
                    hit = scene.ray_intersect(ray)
                    # A lamp in view is no object.
                    covered[y, x] += hit.is_valid() and not hit.shape.is_emitter()
    return covered / RAYS_PER_EDGE**2


def write(path, planes, notes):
    """Half floats, of which 0.05 % is the step; whole or not at all."""
    names = sorted(planes)
    texels = numpy.stack([planes[name] for name in names], axis=-1).astype(numpy.float16)
    form = mitsuba.Bitmap.PixelFormat.MultiChannel
    bitmap = mitsuba.Bitmap(texels, pixel_format=form, channel_names=names)
    for key, value in notes.items():
        bitmap.metadata()[key] = value
    folder = os.path.dirname(os.path.abspath(path))
    handle, temporary = tempfile.mkstemp(suffix=".exr", dir=folder)
    os.close(handle)
    try:
        bitmap.write(temporary)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


if __name__ == "__main__":
    main()
