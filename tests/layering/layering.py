#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Says where a library includes or links one that it must not know: arrows point downward only.

layering.py ROOT          exit status 1 and a line for each violation under ROOT/src, ROOT/apps and ROOT/python
layering.py --self-test   plants violations in a copy of nothing but themselves and expects each to be found
"""
import pathlib
import re
import sys
import tempfile

# Which of our libraries each one may use. Only apps may use everything; nothing may use apps or python.
MAY_USE = {
    "base": set(),
    "physics": {"base"},
    "neighbours": {"base"},
    "core": {"base", "physics", "neighbours"},
}
MAY_USE["comm/mpi"] = {"base", "core"}
for upper in ("passes", "backends/reference", "backends/cpu", "backends/gpu", "scene", "io", "render/gl", "render"):
    MAY_USE[upper] = {"base", "physics", "neighbours", "core"}
MAY_USE["backends/cpu"] |= {"passes"}
MAY_USE["backends/gpu"] |= {"passes"}
MAY_USE["render/gl"] |= {"render"}
MAY_USE["volumes"] = {"base", "physics", "neighbours", "core"}
for user in ("scene", "io"):
    MAY_USE[user].add("volumes")
MAY_USE["run"] = set(MAY_USE) - {"render/gl"}
MAY_USE["python"] = set(MAY_USE) - {"render/gl"}
MAY_USE["apps"] = set(MAY_USE) - {"python"}

# Libraries of others that only some of ours may see: the border where they can be exchanged.
KEPT_TO = {
    r"hdf5|H5\w+\.h": {"io"},
    r"openvdb/": {"volumes"},
    r"mpi\.h|zoltan": {"comm/mpi"},
    r"valijson/": {"scene"},
    r"nlohmann/": {"scene", "io", "apps"},
    r"CLI/": {"apps"},
    r"pybind11/|Python\.h": {"python"},
    r"spdlog/": {"apps"},
    r"GLFW/|imgui|backends/imgui": {"apps"},
    r"epoxy/|(?!GLFW)E?GLE?S?\w*/": {"render/gl"},
    r"cairo|png\.h": {"render"},
    r"([ix]mmintrin|x86intrin|arm_neon)\.h": {"base", "backends/cpu"},
}
# The laws are arithmetic: no containers, no files, no threads.
PHYSICS_INCLUDES = {"cmath", "limits", "cstdint", "cstddef", "type_traits"}

INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]', re.M)
LINK_COMMAND = re.compile(r"(?:hooke_library\s*\(\s*|target_link_libraries\s*\(\s*hooke_)(\w+)([^)]*)\)")
COMMENT = re.compile(r"#[^\n]*")


def library_of(path):
    """The library that a path such as "core/scene.h" or "backends/cpu/isa.h" belongs to, or None."""
    return next((name for name in MAY_USE if path.startswith(name + "/")), None)


def target_library(target):
    """The library of a CMake target's name without hooke_: "backend_cpu" -> "backends/cpu"."""
    name = re.sub(r"^volumes_.*", "volumes", target)
    for start, folder in (("render_", "render/"), ("backend_", "backends/"), ("comm_", "comm/")):
        name = re.sub("^" + start, folder, name)
    return name if name in MAY_USE else None


def check_include(owner, own_folder, source, quote, header):
    if header.startswith("hooke/"):
        used = library_of(header[len("hooke/"):])
        if used is None:
            return f"includes {header}, which belongs to no library of the table"
    elif quote == '"':
        used = library_of((own_folder / header).resolve().relative_to(source).as_posix()) or owner
    else:
        if owner == "physics" and header not in PHYSICS_INCLUDES:
            return f"includes <{header}>: laws are arithmetic"
        for pattern, owners in KEPT_TO.items():
            if re.match(pattern, header) and owner not in owners:
                return f"includes <{header}>, which is kept to {', '.join(sorted(owners))}"
        return None
    if used != owner and used not in MAY_USE[owner]:
        return f"includes {header}: {owner} must not use {used}"
    return None


def violations(root):
    root = pathlib.Path(root).resolve()
    source = root / "src"
    found = []
    for folder in (source, root / "apps", root / "python"):
        for path in sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".cpp", ".inl", ".cu", ".cuh")):
            inside = path.relative_to(source).as_posix() if folder == source else f"{folder.name}/{path.name}"
            owner = library_of(inside)
            text = path.read_text(encoding="utf-8")
            if owner is None:
                found.append(f"{path.relative_to(root)}: belongs to no library of the table")
                continue
            base = source if folder == source else root
            for match in INCLUDE.finditer(text):
                problem = check_include(owner, path.parent, base, *match.groups())
                if problem:
                    line = text.count("\n", 0, match.start(2)) + 1
                    found.append(f"{path.relative_to(root)}:{line}: {problem}")
    for path in sorted(source.rglob("CMakeLists.txt")):
        for target, arguments in LINK_COMMAND.findall(COMMENT.sub("", path.read_text(encoding="utf-8"))):
            owner = target_library(target)
            if owner is None:  # hooke itself: the sum of all
                continue
            for linked in re.findall(r"\bhooke(?:_|::)(\w+)", arguments):
                used = target_library(linked)
                if used is not None and used != owner and used not in MAY_USE[owner]:
                    found.append(f"{path.relative_to(root)}: {owner} must not link {used}")
    return found


PLANTED = [  # file, text, a part of the line expected for it (None: no violation)
    ("src/core/a.cpp", '#include "hooke/base/hash.h"\n#include <vector>\n#include "own.h"\n', None),
    ("src/core/b.cpp", '// x\n#include "hooke/io/checkpoint.h"\n', "src/core/b.cpp:2: includes hooke/io/checkpoint.h"),
    ("src/core/c.cpp", '#include "../scene/load_scene.h"\n', "core must not use scene"),
    ("src/physics/d.h", "#include <vector>\n", "laws are arithmetic"),
    ("src/backends/cpu/e.cpp", '#include "hooke/backends/reference/reference_backend.h"\n',
     "backends/cpu must not use backends/reference"),
    ("src/scene/f.cpp", '#include "hooke/io/format.h"\n', "scene must not use io"),
    ("src/core/g.cpp", "  #  include <hdf5.h>\n", "kept to io"),
    ("src/io/u.cpp", '#include "hooke/volumes/vdb_file.h"\n', None),
    ("src/io/v.cpp", "#include <openvdb/openvdb.h>\n", "kept to volumes"),
    ("src/volumes/w.cpp", '#include "hooke/io/snapshot.h"\n', "volumes must not use io"),
    ("src/core/x.cpp", '#include "hooke/volumes/mesh_field.h"\n', "core must not use volumes"),
    ("src/render/r.cpp", "#include <epoxy/gl.h>\n", "kept to render/gl"),
    ("src/render/gl/y.cpp", "#include <GLFW/glfw3.h>\n", "kept to apps"),
    ("apps/view/z.cpp", "#include <GLFW/glfw3.h>\n#include <imgui.h>\n", None),
    ("src/render/gl/s.cpp", '#include "hooke/render/frame.h"\n#include "hooke/core/scene.h"\n#include <epoxy/gl.h>\n', None),
    ("src/render/t.cpp", '#include "hooke/render/gl/gl_renderer.h"\n', "render must not use render/gl"),
    ("src/misc/h.cpp", "\n", "belongs to no library"),
    ("src/base/CMakeLists.txt", "hooke_library(base SOURCES a.cpp LINKS hooke_core)\n", "base must not link core"),
    ("src/core/CMakeLists.txt", "# hooke_library(core LINKS hooke_io)\nhooke_library(core LINKS hooke_base)\n", None),
    ("src/render/CMakeLists.txt", "hooke_library(render LINKS hooke_core PRIVATE_LINKS hooke_volumes)\n",
     "render must not link volumes"),
    ("src/io/CMakeLists.txt", "hooke_library(io LINKS hooke_core)\ntarget_link_libraries(hooke_io PUBLIC hooke::scene)\n",
     "io must not link scene"),
    ("src/run/aa.cpp", '#include "hooke/scene/load_scene.h"\n#include "hooke/backends/cpu/cpu_backend.h"\n', None),
    ("src/run/ab.cpp", '#include "hooke/render/gl/gl_renderer.h"\n', "run must not use render/gl"),
    ("src/core/af.cpp", "#include <mpi.h>\n", "kept to comm/mpi"),
    ("src/run/ag.cpp", "#include <zoltan.h>\n", "kept to comm/mpi"),
    ("src/comm/mpi/ah.cpp", '#include "hooke/core/communicator.h"\n#include <mpi.h>\n#include <zoltan.h>\n', None),
    ("src/comm/mpi/ai.cpp", '#include "hooke/scene/load_scene.h"\n', "comm/mpi must not use scene"),
    ("src/comm/mpi/CMakeLists.txt", "target_link_libraries(hooke_comm_mpi PUBLIC hooke_io)\n", "comm/mpi must not link io"),
    ("src/io/ac.cpp", '#include "hooke/run/studio.h"\n', "io must not use run"),
    ("src/run/ad.cpp", "#include <pybind11/numpy.h>\n", "kept to python"),
    ("python/ae.cpp", '#include "hooke/run/studio.h"\n#include <pybind11/numpy.h>\n', None),
    ("apps/cli/main.cpp", '#include "hooke/backends/cpu/cpu_backend.h"\n#include <CLI/CLI.hpp>\n#include "run.h"\n', None),
]


def self_test():
    for name, text, expected in PLANTED:
        with tempfile.TemporaryDirectory() as root:
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True)
            path.write_text(text, encoding="utf-8")
            found = violations(root)
        right = not found if expected is None else len(found) == 1 and expected in found[0]
        if not right:
            sys.exit(f"{name}: expected {expected!r}, found {found}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    elif len(sys.argv) == 2:
        problems = violations(sys.argv[1])
        print("\n".join(problems) if problems else "arrows point downward only")
        sys.exit(1 if problems else 0)
    else:
        sys.exit(__doc__)
