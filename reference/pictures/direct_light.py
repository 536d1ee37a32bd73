"""Compares a picture's direct light with ray-traced light: the share of pixels whose shadow is wrong.

    pip install mitsuba numpy
    subsurface export --to mitsuba --materials reference/pictures/materials --material lambert LIGHT --size 960x540 --out scene
    subsurface render --materials reference/pictures/materials --material lambert LIGHT --size 960x540 --out p.exr --aov aov
    python3 reference/pictures/direct_light.py scene aov/irradiance.exr --light=0.66,-0.53,-0.53

LIGHT is one `--light` with `--ambient 0`, and whatever else both take. The irradiance of the AOV, over that of the light, is
compared with the cosine where a ray to the light meets nothing. A pixel is wrong that is off by more than `--off` of full
light; pixels on a silhouette, whose neighbours show other objects or nothing, do not count.
"""

import argparse
import os

import drjit
import mitsuba
import numpy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="what `subsurface export` wrote")
    parser.add_argument("irradiance", help="irradiance.exr of `subsurface render --aov`")
    parser.add_argument("--light", required=True, help="dx,dy,dz[,intensity], as of `render`")
    parser.add_argument("--off", type=float, default=0.2, help="what counts as wrong, of full light (default: 0.2)")
    arguments = parser.parse_args()
    numbers = [float(number) for number in arguments.light.split(",")]
    if len(numbers) not in (3, 4):
        parser.error("--light takes dx,dy,dz or dx,dy,dz,intensity")
    towards = -numpy.array(numbers[:3]) / numpy.linalg.norm(numbers[:3])
    intensity = numbers[3] if len(numbers) == 4 else 1.0
    scene_file = os.path.join(arguments.folder, "red.xml")
    for file in (scene_file, arguments.irradiance):
        if not os.path.isfile(file):
            parser.error(f"there is no {file}")

    try:
        mitsuba.set_variant("llvm_ad_rgb")
    except ImportError as error:
        parser.error(f"{error}: rays are traced all at once with LLVM; on Debian `apt-get install libllvm15`")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    found = numpy.array(mitsuba.Bitmap(arguments.irradiance))[:, :, 0] / (numpy.pi * intensity)
    expected, hit = traced(mitsuba.load_file(scene_file), towards, found.shape)
    inner = hit.copy()
    for shift in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        inner &= numpy.roll(hit, shift, (0, 1))
    wrong = inner & (numpy.abs(found - expected) > arguments.off)
    share = wrong.sum() / max(inner.sum(), 1)
    print(f"{100 * share:.3f} % of {inner.sum()} pixels are off by more than {arguments.off} of full light")


def traced(scene, towards, shape):
    """Cosine to the light by pixel, 0 in shadow; and whether the pixel shows anything."""
    sensor = scene.sensors()[0]
    height, width = shape
    y, x = numpy.mgrid[0:height, 0:width]
    place = mitsuba.Point2f(
        mitsuba.Float((x.ravel() + 0.5) / width), mitsuba.Float((y.ravel() + 0.5) / height)
    )
    ray, _ = sensor.sample_ray(0.0, 0.5, place, mitsuba.Point2f(0.5, 0.5))
    surface = scene.ray_intersect(ray)
    light = mitsuba.Vector3f(*[float(value) for value in towards])
    # Normals turn to the viewer, as the picture's do.
    facing = drjit.sign(drjit.dot(surface.sh_frame.n, -ray.d))
    cosine = numpy.array(drjit.dot(surface.sh_frame.n, light) * facing)
    lit = ~numpy.array(scene.ray_test(surface.spawn_ray(light)))
    hit = numpy.array(surface.is_valid()).reshape(shape)
    expected = numpy.maximum(cosine, 0.0).reshape(shape) * lit.reshape(shape)
    return numpy.where(hit, expected, 0.0), hit


if __name__ == "__main__":
    main()
