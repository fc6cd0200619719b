#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Makes the big siblings of the bundled scenes: make_big_scenes.py [FOLDER], by default scenes.

NAME-big.json is what NAME.json shows, in particles that are smaller by a factor f, so that there are f^3 times as many (in
cloths f^2). Densities, elastic moduli, damping ratios and terminal velocities stay: masses fall by f^3,
stiffnesses by f, dashpots by f^2, drag and the strength of cohesion by f^3, and the time step by f. Of cloths the mass an area stays: masses fall by
f^2, dashpots by f, and stiffnesses stay. What there is one of stays as large as it is.
"""
import json
import pathlib
import re
import sys

# By what factor particles are smaller, and how many there are then.
SCENES = {
    "avalanche": (3, "400,000 lumps of snow"),
    "ball-pit": (5, "500,000 balls"),
    "cloth": (3, "130,000 particles"),
    "drum": (3.5, "430,000 grains"),
    "flag": (3, "55,000 particles"),
    "fountain": (2.5, "400,000 particles"),
    "fracture": (2, "320,000 particles"),
    "glass": (2, "some 240,000 particles"),
    "hourglass": (4, "540,000 grains"),
    "jelly": (3.5, "400,000 particles"),
    "mixed": (3, "550,000 particles"),
    "pillars": (2, "660,000 particles"),
    "trampoline": (3, "75,000 particles"),
    "water": (2, "4 million particles"),
    "wave-tank": (2.8, "520,000 particles"),
}
# In these there are more of the same: how many times, and how many then.
MORE = {
    "fireworks": (20, "800,000 sparks"),
    "galaxy": (20, "400,000 stars"),
}
# In these there is more room, wider along x and z, for more of the same.
WIDER = {
    "crowd": (5, "15,000 people"),
}
CELLS_PER_RADIUS = 3  # of the field of a mesh, where a scene does not say


def read_scene(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return json.loads("\n".join(line for line in lines if not line.lstrip().startswith("//")))


def scale(values, powers, factor):
    """Divides values[key] by factor**power for each key that is there."""
    for key, power in powers.items():
        if key in values and not isinstance(values[key], str):
            value = values[key]
            values[key] = [v / factor**power for v in value] if isinstance(value, list) else rounded(value / factor**power)


def rounded(value):
    return float(f"{value:.5g}")


def is_single(source):
    return source.get("block", {}).get("count") == 1


def mixed(a, b):
    """What a pair of materials without an entry has: docs/theory.md, eq. 8."""
    total = a["stiffness"] + b["stiffness"]
    pair = {"stiffness": 2 * a["stiffness"] * b["stiffness"] / total if total > 0 else 0}
    for key in ("shear", "damping"):
        pair[key] = (a.get(key, 0) + b.get(key, 0)) / 2
    return pair


def make_finer(scene, f):
    materials = scene["materials"]
    kept = {source["material"] for source in scene.get("particles", []) if is_single(source)}
    woven = {cloth["material"] for cloth in scene.get("cloths", [])}
    of_grains = {"stiffness": 1, "shear": 2, "damping": 2}
    of_cloth = {"shear": 1, "damping": 1}
    of_cohesion = {"range": 1, "strength": 3}
    # The mean of what a large ball and a small one have would be too much for the small one.
    contacts = scene.setdefault("contacts", [])
    entered = [set(contact["between"]) for contact in contacts]
    for large in sorted(kept):
        for name, material in materials.items():
            if name not in kept and "radius" in material and {large, name} not in entered:
                contacts.append({"between": [large, name]} | mixed(materials[large], material))
    for contact in contacts:
        if not kept.issuperset(set(contact["between"]) - {"wall"}):
            scale(contact.get("cohesion", {}), of_cohesion, f)
            scale(contact, of_cloth if woven.intersection(contact["between"]) else of_grains, f)
    if not contacts:
        del scene["contacts"]

    scene["time"]["step"] = rounded(scene["time"]["step"] / f)
    smallest = min(material["radius"] for material in materials.values() if "radius" in material)
    for name, material in materials.items():
        if name in woven:
            scale(material, {"radius": 1, "mass": 2, "drag": 2} | of_cloth, f)
        elif name not in kept:
            scale(material.get("cohesion", {}), of_cohesion, f)
            scale(material, {"radius": 1, "mass": 3, "drag": 3} | of_grains, f)
    for collider in scene.get("colliders", []):
        if "mesh" in collider["shape"]:  # no finer than for the larger particles
            collider["shape"]["mesh"]["voxel"] = rounded(smallest / CELLS_PER_RADIUS)
    for source in scene.get("particles", []):
        if not is_single(source) and "block" in source:
            scale(source["block"], {"spacing": 1, "jitter": 1}, f)
            if "count" in source["block"]:
                source["block"]["count"] = round(source["block"]["count"] * f**3)
    for cloth in scene.get("cloths", []):
        cloth["cells"] = [round(cells * f) for cells in cloth["cells"]]
        scale(cloth, {"damping": 1}, f)
    for body in scene.get("bodies", []):
        scale(body, {"spacing": 1, "stiffness": 1, "damping": 2}, f)
    for emitter in scene.get("emitters", []):
        emitter["rate"] = round(emitter["rate"] * f**3)


def make_more(scene, times):
    for name, material in scene["materials"].items():
        if "attraction" in scene:
            scale(material, {"mass": 1, "radius": 1 / 3}, times)
    for emitter in scene.get("emitters", []):
        emitter["rate"] *= times
    for source in scene.get("particles", []):
        source["cluster"]["count"] *= times


def make_wider(value, times):
    """Stretches whatever is a point, but for its height."""
    if isinstance(value, dict):
        return {key: make_wider(inner, times) for key, inner in value.items()}
    if not isinstance(value, list):
        return value
    if len(value) == 3 and all(isinstance(c, (int, float)) for c in value):
        return [rounded(times * value[0]), value[1], rounded(times * value[2])]
    return [make_wider(inner, times) for inner in value]


def to_text(scene, name):
    text = json.dumps(scene, indent=2)
    # Lists of numbers, and what is short, on one line.
    text = re.sub(r"\[\s+([-+0-9.eE,\s]+?)\s+\]", lambda m: "[" + " ".join(m[1].split()) + "]", text)
    text = re.sub(r"\{\s+([^{}]*?)\s+\}", lambda m: "{ " + " ".join(m[1].split()) + " }" if len(m[1]) < 240 else m[0], text)
    return f"// scenes/{name}.json in more detail; made by tools/make_big_scenes.py.\n{text}\n"


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "scenes")
    for name, (factor, count) in (SCENES | MORE | WIDER).items():
        scene = read_scene(folder / f"{name}.json")
        scene["name"] += ", big"
        scene["description"] = f"scenes/{name}.json with {count}"
        if name in WIDER:
            scene = make_wider(scene, factor)
            scene["time"]["end"] *= factor
            scene["camera"]["eye"][1] *= factor
        elif name in MORE:
            make_more(scene, factor)
        else:
            make_finer(scene, factor)
        (folder / f"{name}-big.json").write_text(to_text(scene, name), encoding="utf-8")


if __name__ == "__main__":
    main()
