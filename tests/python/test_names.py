"""Names of files and of what scenes hold are bytes, whatever they are in; a NUL is in none."""

import os

import numpy as np
import pytest

import tyndall

LATIN = b"f\xfcr"  #: no UTF-8


def test_files_have_any_name(tmp_path, floor_text):
    for name in (LATIN, os.fsdecode(LATIN), "для".encode()):
        scene = os.path.join(os.fsencode(tmp_path), os.fsencode(name) + b".pbrt")
        with open(scene, "w") as file:
            file.write(floor_text)
        image = tyndall.load(scene).render(spp=1)
        path = os.fsdecode(scene) + ".exr"
        image.save(path)
        assert np.array_equal(tyndall.read_image(os.fsencode(path)).rgb, image.rgb)
        assert tyndall.diff(path, os.fsencode(path), exact=True, flip=False)


def test_bytes_name_files(tmp_path):
    image = tyndall.Image.from_rgb(np.ones((4, 5, 3)))
    path = os.fsencode(tmp_path / "y.exr")
    image.save(path, half=True)
    assert tyndall.read_image(path).shape == (4, 5)
    with pytest.raises(ValueError, match="half, compression and parts"):
        image.save(path[:-4] + b".png", half=True)


def test_errors_tell_of_files_of_any_name(tmp_path, floor_text):
    path = str(tmp_path / os.fsdecode(LATIN)) + ".pbrt"
    for attempt in (tyndall.load, tyndall.read_image):
        with pytest.raises(tyndall.Error, match="f\ufffdr.pbrt"):
            attempt(path)
    with open(path, "w") as file:
        file.write(floor_text.replace('"sphere"', '"spheer"'))
    with pytest.raises(tyndall.Error, match="f\ufffdr.pbrt:17:3") as caught:
        tyndall.load(path)
    assert caught.value.file == path and os.path.exists(caught.value.file)


def test_names_in_scenes_come_back(floor_text):
    name = os.fsdecode(LATIN)
    scene = tyndall.loads(floor_text.encode().replace(b'"fog"', b'"' + LATIN + b'"').replace(b'"grey"', b'"' + LATIN + b'"'))
    assert scene.media == scene.materials == [name]
    scene.replace_medium(name, tyndall.HomogeneousMedium())
    scene.add_sphere((0, 0, 0), 1, material=scene.materials[0])
    scene.lights = [tyndall.ProjectionLight(path=name + ".png"), tyndall.InfiniteLight(where=(name, 3, 4))]
    assert scene.lights[0].path == name + ".png" and scene.lights[1].where == (name, 3, 4)


def test_warnings_are_told(floor_text):
    with pytest.warns(tyndall.SceneWarning) as told:
        tyndall.loads('Option "bool disablepixeljitter" true\n' + floor_text, name=os.fsdecode(LATIN))
    assert told[0].message.file == os.fsdecode(LATIN)


@pytest.mark.parametrize("attempt", [
    lambda scene: tyndall.load("a\0.pbrt"),
    lambda scene: tyndall.loads("WorldBegin", name="a\0"),
    lambda scene: tyndall.loads("WorldBegin", folder="a\0"),
    lambda scene: tyndall.read_image(b"a\0.exr"),
    lambda scene: tyndall.Image.from_rgb(np.ones((2, 2, 3))).save("a\0.exr"),
    lambda scene: tyndall.Image({"a\0": np.ones((2, 2))}).save("a.exr"),
    lambda scene: scene.add_material("a\0", 0.5),
    lambda scene: scene.add_medium(tyndall.HomogeneousMedium(name="a\0")),
    lambda scene: scene.add_medium(tyndall.HomogeneousMedium(group="a\0")),
    lambda scene: scene.replace_medium("fog\0", tyndall.HomogeneousMedium()),
    lambda scene: scene.add_sphere((0, 0, 0), 1, material="grey\0"),
    lambda scene: setattr(scene, "lights", [tyndall.PointLight(group="a\0")]),
    lambda scene: setattr(scene, "lights", [tyndall.InfiniteLight(path="a\0.exr")]),
])
def test_a_nul_is_in_no_name(floor, attempt, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="is no name; leave NUL"):
        attempt(floor)
    assert not list(tmp_path.iterdir()) and floor.materials == ["grey"] and floor.media == ["fog"]


def test_numbers_are_no_names(floor):
    for attempt in (tyndall.load, tyndall.read_image, lambda name: floor.add_material(name, 0.5)):
        with pytest.raises(TypeError, match="= 7 is not understood; give a name"):
            attempt(7)
