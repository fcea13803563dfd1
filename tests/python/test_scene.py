"""Scenes: what is read, what edits do, what cannot be."""

import copy
import dataclasses
import pickle
import warnings

import numpy as np
import pytest

import tyndall

MATRIX = np.array([[0.0, 0, 1, 2], [0, 1, 0, 3], [-1, 0, 0, 4], [0, 0, 0, 1]])
LIGHTS = [
    tyndall.PointLight((1, 2, 3), I=(4, 5, 6), group="key"),
    tyndall.SpotLight(MATRIX, I=2, cone_angle=40, falloff_start=10),
    tyndall.DistantLight((0, -1, 0.5), E=3),
    tyndall.InfiniteLight(L=(0.25, 0.5, 1), path="sky.exr", to_world=MATRIX, illuminance=5,
                          portal=((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)), to_rec709=tuple(range(9))),
    tyndall.GoniometricLight(MATRIX, I=2, path="lamp.ies", power=60),
    tyndall.ProjectionLight(MATRIX, I=2, path="slide.png", fov=45, power=None, where=("a.pbrt", 3, 1)),
]


@pytest.mark.parametrize("light", LIGHTS, ids=lambda light: type(light).__name__)
def test_lights_come_back_as_they_were(light):
    scene = tyndall.Scene()
    scene.lights = [light]
    assert scene.lights == (light,)
    colour = next(name for name in ("I", "E", "L") if hasattr(light, name))
    for change in ({"group": "other"}, {colour: 0.125}):
        assert scene.lights != (dataclasses.replace(light, **change),)


def test_twice_the_light_is_twice_the_picture(floor):
    once = floor.render(seed=7)
    floor.lights = [dataclasses.replace(light, I=np.multiply(light.I, 2)) for light in floor.lights]
    assert np.array_equal(floor.render(seed=7).rgb, 2 * once.rgb)
    floor.lights = ()
    assert not floor.render().rgb.any()


def test_a_light_is_added(floor):
    before = floor.render(seed=7).rgb.mean()
    floor.lights += (tyndall.InfiniteLight(L=1),)
    assert len(floor.lights) == 2 and floor.render(seed=7).rgb.mean() > before + 0.2


def test_what_is_no_light_changes_nothing(floor):
    before = floor.lights
    with pytest.raises(TypeError, match="is no light"):
        floor.lights = [tyndall.PointLight(), floor.camera]
    assert floor.lights == before


@pytest.mark.parametrize("change", [
    lambda scene: setattr(scene, "camera", tyndall.PointLight()),
    lambda scene: scene.add_medium("fog"),
    lambda scene: scene.replace_medium("fog", scene.camera),
    lambda scene: setattr(scene, "camera", tyndall.Camera(kind=7)),
    lambda scene: setattr(scene, "lights", [tyndall.PointLight(where=7)]),
    lambda scene: setattr(scene, "settings", {7: 1}),
    lambda scene: scene.compare({"a": 7}, spp=1),
])
def test_values_of_another_kind(floor, change):
    with pytest.raises(TypeError, match="is no |is not "):
        change(floor)


def test_the_camera_is_changed(floor, floor_text):
    assert floor.camera.fov == pytest.approx(45)
    assert floor.camera.to_world[:3, 3] == pytest.approx((0, 1, -4))
    floor.camera = dataclasses.replace(floor.camera, fov=20)
    narrow = tyndall.loads(floor_text.replace('"float fov" 45', '"float fov" 20'))
    assert np.array_equal(floor.render().rgb, narrow.render().rgb)
    floor.camera = tyndall.Camera.look_at((0, 5, 0), (0, 0, 0), up=(0, 0, 1), fov=30)
    assert floor.render(spp=4, aovs=["Z"])["Z"].mean() == pytest.approx(5, rel=0.01)


def test_cameras_that_cannot_be(floor):
    with pytest.raises(ValueError, match="fov"):
        tyndall.Camera(fov=180)
    with pytest.raises(ValueError, match="choose from perspective"):
        floor.camera = tyndall.Camera(kind="pinhole")
    with pytest.raises(ValueError, match="lenses"):
        floor.camera = tyndall.Camera(kind="realistic")


def test_the_resolution_and_settings(floor):
    assert floor.resolution == (40, 24)
    floor.resolution = 10, 6
    assert floor.render(spp=1).shape == (6, 10)
    with pytest.raises(ValueError, match="resolution"):
        floor.resolution = 0, 6
    for size in ((8.9, 6), "88", (None, 6), 8):
        with pytest.raises(TypeError):
            floor.resolution = size
    assert floor.resolution == (10, 6)
    assert floor.settings["spp"] == 4 and floor.settings["max_depth"] == 3 and floor.settings["lights"] == "tree"
    floor.settings = {"spp": 2, "lights": "power"}
    assert floor.settings["lights"] == "power" and floor.render().report["samples"] == 2


def test_a_scene_by_hand_is_the_scene_of_a_file():
    """A floor of arrays and a sphere against the same in a file: the same bits."""
    text = """
Film "rgb" "integer xresolution" 30 "integer yresolution" 20
LookAt 0 1 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 45
WorldBegin
LightSource "point" "point3 from" [2 3 -3] "rgb I" [30 20 10]
Material "diffuse" "rgb reflectance" [0.7 0.5 0.3]
Shape "trianglemesh" "point3 P" [-4 -1 -4 4 -1 -4 4 -1 4 -4 -1 4] "integer indices" [0 1 2 0 2 3]
Translate 0.5 0 0
Shape "sphere" "float radius" 0.75
"""
    scene = tyndall.Scene()
    scene.resolution = 30, 20
    scene.camera = tyndall.Camera.look_at((0, 1, -4), (0, 0, 0), fov=45)
    scene.lights = [tyndall.PointLight((2, 3, -3), I=(30, 20, 10))]
    scene.add_material("clay", (0.7, 0.5, 0.3))
    corners = [(-4, -1, -4), (4, -1, -4), (4, -1, 4), (-4, -1, 4)]
    scene.add_mesh(corners, [(0, 1, 2), (0, 2, 3)], material="clay")
    scene.add_sphere((0.5, 0, 0), 0.75, material="clay")
    assert np.array_equal(scene.render(spp=4).rgb, tyndall.loads(text).render(spp=4).rgb)


def test_shapes_that_emit():
    scene = tyndall.Scene()
    scene.resolution = 8, 8
    scene.camera = tyndall.Camera.look_at((0, 0, -4), (0, 0, 0), fov=10)
    scene.add_material("black", 0)
    scene.add_sphere((0, 0, 0), 2, material="black", emission=(1, 2, 3))
    assert scene.render(spp=4).rgb.reshape(-1, 3).mean(axis=0) == pytest.approx((1, 2, 3))


@pytest.mark.parametrize("arguments, message", [
    (([(0, 0)], [(0, 0, 0)]), "positions"),
    (([(0, 0, np.inf)] * 3, [(0, 1, 2)]), "positions"),
    (([(0, 0, 0)] * 3, [(0, 1, 3)]), "indices from 0 to 3 for 3"),
    (([(0, 0, 0)] * 3, [(0, -1, 2)]), "indices from -1"),
    (([(0, 0, 0)] * 3, [(0.5, 1, 2)]), "integers"),
])
def test_meshes_that_cannot_be(floor, arguments, message):
    with pytest.raises(ValueError, match=message):
        floor.add_mesh(*arguments, material="grey")
    with pytest.raises(ValueError, match="normals has 1 rows"):
        floor.add_mesh(np.eye(3), [(0, 1, 2)], material="grey", normals=[(0, 0, 1)])
    with pytest.raises(tyndall.Error, match='no material is called "gray"; choose from grey'):
        floor.add_mesh(np.eye(3), [(0, 1, 2)], material="gray")


@pytest.mark.parametrize("copied", [tyndall.Scene.copy, copy.copy, copy.deepcopy], ids=["Scene.copy", "copy", "deepcopy"])
def test_copies_are_apart(floor, copied):
    other = copied(floor)
    other.lights = ()
    other.add_material("new", 0.5)
    assert len(floor.lights) == 1 and floor.materials == ["grey"] and other.materials == ["grey", "new"]


def test_scenes_are_not_pickled(floor):
    with pytest.raises(TypeError, match="a Scene cannot be pickled"):
        pickle.dumps(floor)


def test_errors_have_a_place(tmp_path, floor_text):
    broken = tmp_path / "broken.pbrt"
    broken.write_text(floor_text.replace('Shape "sphere"', 'Shape "spheer"'))
    with pytest.raises(tyndall.Error, match="spheer") as caught:
        tyndall.load(broken)
    line = broken.read_text().split("\n").index('  Shape "spheer" "float radius" 0.5') + 1
    assert (caught.value.file, caught.value.line, caught.value.column) == (str(broken), line, 3)
    assert caught.value.failure == "scene" and str(caught.value).startswith(f"{broken}:{line}:3: ")
    with pytest.raises(tyndall.Error) as caught:
        tyndall.load(tmp_path / "none.pbrt")
    assert (caught.value.file, caught.value.line, caught.value.column) == (str(tmp_path / "none.pbrt"), None, None)


def test_errors_of_building_have_a_place(tmp_path, floor_text):
    (tmp_path / "sky.exr").write_bytes(b"no image")
    text = floor_text.replace("WorldBegin", 'WorldBegin\nLightSource "infinite" "string filename" "sky.exr"')
    scene = tyndall.loads(text, folder=tmp_path)
    with pytest.raises(tyndall.Error) as caught:
        scene.render()
    assert caught.value.file == "<text>" and caught.value.line == 8


def test_warnings_are_pythons(floor_text):
    with pytest.warns(tyndall.SceneWarning) as told:
        tyndall.loads('ColorSpace "srgb"\nOption "bool disablepixeljitter" true\n' + floor_text)
    assert told[0].message.file == "<text>" and told[0].message.line == 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tyndall.loads(floor_text)
