"""Lights, cameras, media and arrays that scene files refuse are refused as they are made, with the same bounds."""

import dataclasses

import numpy as np
import pytest

import tyndall
from tyndall import Camera, DistantLight, GoniometricLight, GridMedium, HomogeneousMedium, InfiniteLight, PointLight, ProjectionLight, SpotLight

NAN, INF = float("nan"), float("inf")
HUGE = 1e39  #: more than a float holds
VOXELS = dict(density=np.ones((2, 2, 2)), bounds=((0, 0, 0), (1, 1, 1)))


def refused(kind, fields, message=None):
    with pytest.raises(ValueError, match=message or next(iter(fields))):
        kind(**fields)


@pytest.mark.parametrize("angle", [NAN, -5, 0, 200, INF])
def test_cones(angle):
    refused(SpotLight, dict(cone_angle=angle))
    assert SpotLight(cone_angle=180).cone_angle == 180


@pytest.mark.parametrize("cone, start", [(30, 25), (20, 15), (5, 0), (2, 2), (90, 85)])
def test_the_falloff_starts_before_the_cone_ends_as_in_files(cone, start):
    light = SpotLight(cone_angle=cone)
    assert light.falloff_start == start
    text = f'WorldBegin LightSource "spot" "float coneangle" {cone}'
    assert tyndall.loads(text).lights[0].falloff_start == start
    scene = tyndall.Scene()
    scene.lights = [light]
    assert scene.lights == (light,)


@pytest.mark.parametrize("start", [20.5, -1, NAN])
def test_falloffs_are_within_the_cone(start):
    refused(SpotLight, dict(falloff_start=start, cone_angle=20))
    with pytest.raises(ValueError, match="falloff_start"):
        dataclasses.replace(SpotLight(), cone_angle=10)
    assert SpotLight(cone_angle=20.1, falloff_start=20.1).falloff_start == 20.1


@pytest.mark.parametrize("fov", [0, 180, 200, NAN])
def test_fields_of_view(fov):
    refused(ProjectionLight, dict(fov=fov))
    refused(Camera, dict(fov=fov))


@pytest.mark.parametrize("direction", [(0, 0, 0), (1e-30, 0, 0), (0, 1e30, 0), (0, 0, NAN)])
def test_directions_have_a_length(direction):
    refused(DistantLight, dict(direction=direction))


@pytest.mark.parametrize("kind, name", [(InfiniteLight, "illuminance"), (GoniometricLight, "power"), (ProjectionLight, "power")])
def test_photometric_strengths(kind, name):
    for strength in (-1, NAN, INF, HUGE):
        refused(kind, {name: strength})
    assert getattr(kind(**{name: 0}), name) is None and getattr(kind(**{name: 3}), name) == 3
    with pytest.raises(TypeError, match=name):
        kind(**{name: "bright"})


@pytest.mark.parametrize("fields", [
    dict(lens_radius=NAN), dict(lens_radius=-1), dict(focal_distance=0), dict(focal_distance=-1), dict(focal_distance=NAN),
    dict(screen_window=(1, 1, 0, 1)), dict(screen_window=(0, 1, 2, 2)), dict(screen_window=(0, 1, 0, NAN)), dict(screen_window=(0, 1)),
    dict(frame_aspect_ratio=0), dict(frame_aspect_ratio=-1), dict(frame_aspect_ratio=NAN),
])
def test_cameras(fields):
    refused(Camera, fields)


@pytest.mark.parametrize("portal", [np.zeros((3, 3)), np.zeros((4, 2)), np.full((4, 3), NAN)], ids=["corners", "flat", "nan"])
def test_portals(portal):
    refused(InfiniteLight, dict(portal=portal))


def test_what_a_float_cannot_hold(floor):
    refused(PointLight, dict(position=(HUGE, 0, 0)))
    refused(PointLight, dict(I=HUGE))
    refused(SpotLight, dict(to_world=np.diag([HUGE, 1, 1, 1])))
    refused(GridMedium, {**VOXELS, "density": np.full((2, 2, 2), HUGE)}, "density has values")
    with pytest.raises(ValueError, match="positions has values"):
        floor.add_mesh(HUGE * np.eye(3), [(0, 1, 2)], material="grey")
    for radius in (HUGE, 1e-60, NAN, 0):
        with pytest.raises(ValueError, match="radius"):
            floor.add_sphere((0, 0, 0), radius, material="grey")


def test_reflectances_are_at_most_1(floor):
    with pytest.raises(ValueError, match="reflectance is one or three numbers, from 0 to 1"):
        floor.add_material("bright", (0.5, 1.01, 0.5))
    floor.add_material("white", 1)


@pytest.mark.parametrize("g", [1, -1, 1 - 1e-12, NAN])
def test_mean_cosines(g):
    refused(HomogeneousMedium, dict(g=g))


@pytest.mark.parametrize("scale", [-1, NAN, INF])
def test_scales_of_emission(scale):
    refused(GridMedium, dict(Le_scale=scale, **VOXELS))
    refused(GridMedium, dict(Le_scale=scale, temperature=np.ones((2, 2, 2)), **VOXELS))
    refused(GridMedium, dict(Le_scale=1e30, Le=1e30, **VOXELS), "Le times Le_scale")


def test_values_keep_copies_that_cannot_be_written():
    density, matrix = np.ones((2, 2, 2), np.float32), np.eye(4)
    medium = GridMedium(density=density, temperature=density, transform=matrix)
    light, camera = SpotLight(matrix), Camera(to_world=matrix)
    density[0, 0, 0], matrix[0, 3] = 7, 7
    for kept in (medium.density, medium.temperature, medium.transform, light.to_world, camera.to_world, Camera().to_world):
        assert kept.max() == 1
        with pytest.raises(ValueError, match="read-only"):
            kept[0] = 2


def test_what_is_far_away_is_not_singular(floor):
    floor.add_sphere((1e8, 0, 0), 1, material="grey")
    floor.add_mesh(np.eye(3), [(0, 1, 2)], material="grey", to_world=[[1e-6, 0, 0, 1e12], [0, 1e-6, 0, 0], [0, 0, 1e-6, 0], [0, 0, 0, 1]])
    floor.camera = Camera.look_at((0, 0, 1e8), (0, 0, 0), fov=1e-4)
    voxel = np.diag([1e-7, 1e-7, 1e-7, 1.0])
    voxel[:3, 3] = 5000
    assert GridMedium(density=np.ones((2, 2, 2)), transform=voxel).transform[0, 3] == 5000
    flat = np.array([[1, 2, 0, 0], [2, 4, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    refused(SpotLight, dict(to_world=flat), "singular")


def test_lights_outside_of_rec709_come_out_of_files_and_go_back():
    text = 'WorldBegin ColorSpace "rec2020" LightSource "point" "rgb I" [0 1 0]'
    scene = tyndall.loads(text)
    (light,) = scene.lights
    assert min(light.I) < 0 < max(light.I)
    scene.lights = [light]
    assert scene.lights == (light,)
    for color in ((-1, 0, 0), (-1, -1, -1), -1, (1, NAN, 1), (1, -INF, 1)):
        refused(PointLight, dict(I=color))
