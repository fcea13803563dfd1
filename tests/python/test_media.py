"""Media of arrays are where, and as dense, as they say."""

import sys

import numpy as np
import pytest

import tyndall
from tyndall import GridMedium, HomogeneousMedium


def depths(scene, spp=64):
    """Optical depths of the red channel by pixel."""
    return -np.log(np.maximum(scene.render(spp=spp, aovs=["Transmittance"])["Transmittance.R"], 1e-6))


def mass(scene):
    """The integral of the extinction over the picture's column of space."""
    scene.resolution = 48, 48  # pixels so small that their depths may be averaged
    return depths(scene, spp=256).sum() * (4 / 48) ** 2


def test_a_homogeneous_box_attenuates_by_its_depth(backlit):
    backlit.add_medium(HomogeneousMedium(sigma_a=0.5, sigma_s=0, bounds=((-3, -3, -1), (3, 3, 2))))
    assert depths(backlit) == pytest.approx(np.full((16, 16), 1.5), abs=1e-4)


def test_voxels_are_indexed_x_y_z(backlit):
    density = np.zeros((4, 2, 3))
    density[3, 1, 0] = 1
    backlit.add_medium(GridMedium(density=density, sigma_a=2, sigma_s=0, bounds=((-2, -2, -1), (2, 2, 1))))
    seen = depths(backlit)
    y, x = np.unravel_index(np.argmax(seen), seen.shape)
    right = seen[:, 8:].sum() > seen[:, :8].sum()
    image_x_is_world_x = np.allclose(np.sign(backlit.camera.to_world[0, 0]), 1)
    assert (seen[:8].sum() > 4 * seen[8:].sum()) and y < 8, "the upper half in y"
    assert right == image_x_is_world_x and (x >= 12 or x < 4), "the end of x"


def test_depth_along_z_is_that_of_all_voxels(backlit):
    density = np.zeros((2, 3, 5))
    density[:, :, 0] = 1
    density[:, :, 4] = 2
    backlit.add_medium(GridMedium(density=density, sigma_a=0.25, sigma_s=0, bounds=((-9, -9, 0), (9, 9, 5))))
    # A voxel at the end of the box: half a cell of 0.5 to 1 of its value (nothing is outside), then a cell down to 0.
    assert depths(backlit).mean() == pytest.approx(0.25 * 3 * (0.375 + 0.5), rel=0.02)


def test_a_grid_by_transform_holds_all_its_mass(backlit):
    """Interpolated to 0 around, as OpenVDB's grids are: the integral is the sum over voxels times their volume."""
    density = np.random.default_rng(3).random((5, 4, 6))
    transform = np.array([[0.3, 0, 0.1, -0.8], [0, 0.35, 0, -0.6], [0, 0.1, 0.25, -1], [0, 0, 0, 1]])
    backlit.add_medium(GridMedium(density=density, sigma_a=0.5, sigma_s=0, transform=transform))
    assert mass(backlit) == pytest.approx(0.5 * density.sum() * np.linalg.det(transform[:3, :3]), rel=0.02)


def test_a_voxel_by_transform_is_where_it_takes_it(backlit):
    density = np.zeros((6, 3, 2))
    density[4, 2, 1] = 1
    transform = np.array([[0.2, 0, 0, 0.1], [0, 0.3, 0, -0.5], [0, 0, 0.4, -1], [0, 0, 0, 1]])
    backlit.add_medium(GridMedium(density=density, sigma_a=0.5, sigma_s=0, transform=transform))
    backlit.resolution = 48, 48
    seen = depths(backlit, spp=256)
    rows, columns = (2 - (np.arange(48) + 0.5) / 12 for _ in range(2))
    x, y, _, _ = transform @ (4, 2, 1, 1)
    assert (seen.sum(axis=1) * rows).sum() / seen.sum() == pytest.approx(y, abs=0.02)
    toward_right = np.sign(backlit.camera.to_world[0, 0])
    assert (seen.sum(axis=0) * columns).sum() / seen.sum() == pytest.approx(-toward_right * x, abs=0.02)


def test_a_mirrored_transform_holds_it_too(backlit):
    backlit.add_medium(GridMedium(density=np.ones((4, 4, 4)), sigma_a=0.5, sigma_s=0, transform=np.diag([-0.4, 0.4, 0.4, 1])))
    assert mass(backlit) == pytest.approx(0.5 * 64 * 0.4**3, rel=0.02)


def test_densities_of_three_channels(backlit):
    density = np.zeros((2, 2, 2, 3))
    density[..., 0], density[..., 2] = 1, 3
    backlit.add_medium(GridMedium(density=density, sigma_a=(0.5, 0.5, 0.25), sigma_s=0, bounds=((-9, -9, -1), (9, 9, 1))))
    image = backlit.render(spp=64)
    whole = 2 * 0.875  # of two voxels' cells along z, as above
    wanted = np.exp(-whole * np.array([0.5, 0, 0.75]))
    assert image.rgb.mean(axis=(0, 1)) == pytest.approx(wanted, rel=0.02)


def test_what_is_hot_glows_red(backlit):
    backlit.lights = []
    hot = np.full((2, 2, 2), 1500.0)
    backlit.add_medium(GridMedium(density=np.ones((2, 2, 2)), temperature=hot, sigma_a=1, sigma_s=0, bounds=((-1, -1, -1), (1, 1, 1))))
    red, green, blue = backlit.render(spp=16).rgb.mean(axis=(0, 1))
    assert red > 2 * green > 2 * blue


def radiance_of(power):
    """Through two voxels' cells of density 1: of emission density^power, attenuated."""
    t = np.linspace(0, 2, 20001)
    density = np.minimum(1, 0.5 + np.minimum(t, 2 - t))
    depth = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(t))])
    return np.trapz(density**power * np.exp(-depth), t)


@pytest.mark.parametrize("channels, power", [((), 1), ((3,), 2)])
def test_emission_of_one_colour(backlit, channels, power):
    backlit.lights = []
    backlit.add_medium(GridMedium(density=np.ones((2, 2, 2) + channels), Le=(0, 1, 0.5), Le_scale=2, sigma_a=1, sigma_s=0,
                                  bounds=((-9, -9, -1), (9, 9, 1))))
    wanted = 2 * radiance_of(power) * np.array([0, 1, 0.5])
    assert backlit.render(spp=64).rgb.mean(axis=(0, 1)) == pytest.approx(wanted, rel=0.02)


def test_a_medium_is_replaced_where_it_stands(floor):
    before = floor.render(seed=1)
    floor.replace_medium("fog", HomogeneousMedium(sigma_a=0, sigma_s=0))
    without = floor.render(seed=1)
    assert floor.media == ["fog"]
    assert tyndall.diff(before, without, max_relmse=1e-4).same is False
    assert floor.render(aovs=["Transmittance"])["Transmittance.R"].min() == 1


class FloatGrid:
    """What GridMedium.from_openvdb asks of a grid of OpenVDB's Python module."""

    def __init__(self, values, low, spacing):
        self.values, self.low, self.spacing = values, low, spacing
        self.transform = self

    def evalActiveVoxelBoundingBox(self):
        return self.low, tuple(a + n - 1 for a, n in zip(self.low, self.values.shape))

    def copyToArray(self, array, ijk):
        assert tuple(ijk) == tuple(self.low)
        array[...] = self.values

    def indexToWorld(self, ijk):
        return tuple(self.spacing * i for i in ijk)


def test_openvdb_grids_come_with_their_transform():
    values = np.random.default_rng(5).random((3, 2, 4)).astype(np.float32)
    medium = GridMedium.from_openvdb(FloatGrid(values, (-5, 7, 2), 0.25), name="smoke")
    assert np.array_equal(medium.density, values)
    assert medium.transform @ (0, 0, 0, 1) == pytest.approx((-1.25, 1.75, 0.5, 1))
    assert medium.transform @ (1, 1, 1, 1) == pytest.approx((-1, 2, 0.75, 1))


@pytest.mark.skipif("pyopenvdb" not in sys.modules and not __import__("importlib").util.find_spec("pyopenvdb"),
                    reason="OpenVDB's Python module is not there")
def test_a_real_openvdb_grid():
    import pyopenvdb

    grid = pyopenvdb.FloatGrid()
    values = np.random.default_rng(6).random((3, 5, 2)).astype(np.float32) + 0.5
    grid.copyFromArray(values, ijk=(1, -2, 3))
    grid.transform = pyopenvdb.createLinearTransform(voxelSize=0.5)
    medium = GridMedium.from_openvdb(grid)
    assert np.array_equal(medium.density, values)
    assert medium.transform @ (0, 0, 0, 1) == pytest.approx((0.5, -1, 1.5, 1))


BOX = ((0, 0, 0), (1, 1, 1))


@pytest.mark.parametrize("fields, message", [
    (dict(bounds=BOX), "has a density"),
    (dict(density=np.ones((2, 2, 2))), "either bounds or transform"),
    (dict(density=np.ones((2, 2, 2)), bounds=BOX, transform=np.eye(4)), "either bounds or transform"),
    (dict(density=np.ones((2, 2)), bounds=BOX), r"\[x, y, z\]"),
    (dict(density=np.ones((2, 2, 2, 4)), bounds=BOX), r"\[x, y, z\]"),
    (dict(density=np.full((2, 2, 2), np.nan), bounds=BOX), "NaN"),
    (dict(density=np.full((2, 2, 2), -1), bounds=BOX), "below 0"),
    (dict(density=np.ones((2, 2, 2)), bounds=((0, 0, 0), (1, 0, 1))), "two corners"),
    (dict(density=np.ones((2, 2, 2)), transform=np.zeros((4, 4))), "last row"),
    (dict(density=np.ones((2, 2, 2)), transform=np.diag([1, 0, 1, 1])), "singular"),
    (dict(density=np.ones((2, 2, 2)), temperature=np.ones((2, 2, 3)), bounds=BOX), "shape"),
    (dict(density=np.ones((2, 2, 2)), bounds=BOX, sigma_s=-1), "sigma_s"),
    (dict(density=np.ones((2, 2, 2)), bounds=BOX, g=1.5), "g is a number between"),
])
def test_what_cannot_be_is_said(fields, message):
    with pytest.raises(ValueError, match=message):
        GridMedium(**fields)


def test_names_are_their_own(floor):
    with pytest.raises(tyndall.Error, match='"fog" is there already'):
        floor.add_medium(HomogeneousMedium(name="fog"))
    with pytest.raises(tyndall.Error, match='no medium is called "smoke"; choose from fog'):
        floor.replace_medium("smoke", HomogeneousMedium())
