# SPDX-License-Identifier: MIT
"""run_usage.py GMSIM: what the library's rule files and the help of the commands say about their use.

Commands (`gmsim …`) of the blocks that begin with `/// Usage:` are run, parts of scenes (`tear: …`)
are run in a small scene. Help texts: every example that starts with `gmsim` is a command line that
the program understands. Files that examples speak of are made here.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

GMSIM = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE_KEYS = ("interactions", "tear", "loads", "prepare", "output")

SPRINGS_2D = "stretch_spring: { stiffness: 60 }, linear_shear_spring: { stiffness: 40 }"
SPRINGS_3D = "stretch_spring: { stiffness: 60 }, shear_spring_3d: { stiffness: 40 }"
MESHES = {
    2: ("grid: { patches: [4, 4], size: [1, 1] }", SPRINGS_2D),
    "2 triangles": ("grid: { patches: [4, 4], size: [1, 1], cells: triangles }", SPRINGS_2D),
    3: ("box: { cells: [2, 2, 2], size: [1, 1, 1], elements: hexes }", SPRINGS_3D),
}


def gmsim(*arguments, folder):
    result = subprocess.run([GMSIM, *arguments], cwd=folder, capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


def usage_blocks():
    """(file, lines) of every usage block, without comment signs."""
    for path in sorted((ROOT / "stdlib-rules").rglob("*.rule")):
        lines = path.read_text().splitlines()
        for number, line in enumerate(lines):
            if not line.startswith("/// Usage:"):
                continue
            block = [line[len("/// Usage:"):]]
            for more in lines[number + 1:]:
                if not more.startswith("///") or not more[3:].strip():
                    break
                block.append(more[3:])
            yield path.relative_to(ROOT), [text.rstrip() for text in block if text.strip()]


def examples(block):
    """Commands and parts of scenes, the latter with the lines below that are indented more."""
    found = []
    for line in block:
        depth = len(line) - len(line.lstrip())
        if found and depth > found[-1][0]:
            found[-1][1].append(line[found[-1][0]:])
        else:
            found.append((depth, [line.strip()]))
    return ["\n".join(lines) for _, lines in found]


def write_obj(path, points, faces):
    lines = ["v %g %g %g" % point for point in points]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


def make_files(folder):
    """Meshes by the names that examples use."""
    square = [(x, y, 0) for y in range(3) for x in range(3)]
    quads = [(k, k + 1, k + 4, k + 3) for k in (0, 1, 3, 4)]
    write_obj(folder / "surface.obj", square, quads)
    cube = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    sides = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
    write_obj(folder / "sphere.obj", cube, sides)
    hexagon = [(2, 0, 0), (1, 2, 0), (-1, 2, 0), (-2, 0, 0), (-1, -2, 0), (1, -2, 0)]
    write_obj(folder / "hexagons.obj", hexagon, [range(6)])
    # Two faces whose common border has a vertex in its middle.
    write_obj(folder / "coarse.obj",
              [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0), (2, 0, 0), (2, 2, 0)],
              [(0, 1, 2, 3, 4), (1, 5, 6, 3, 2)])
    # Two squares that share no point.
    (folder / "parts.msh").write_text(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n"
        + "".join(f"{4 * k + i + 1} {2 * k + x} {y} 0\n" for k in range(2)
                  for i, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))))
        + "$EndNodes\n$Elements\n2\n1 3 2 0 1 1 2 3 4\n2 3 2 0 1 5 6 7 8\n$EndElements\n")


def run_scene(part, folder):
    """Some small scene must run with this in it."""
    said = ""
    for dimension, (mesh, springs) in MESHES.items():
        body = f"  - mesh: {{ {mesh} }}\n    mass: 1\n"
        rest = ""
        if part.startswith("interactions:") or part.startswith("prepare:"):
            body += f"    {part}\n"
        else:
            rest = part + "\n"
        if not part.startswith("interactions:"):
            body += f"    interactions: {{ {springs} }}\n"
        (folder / "scene.yaml").write_text(
            f"dimension: {str(dimension)[0]}\nbodies:\n{body}{rest}"
            "integrator: { dt: auto }\nduration: 0.01\n")
        code, said = gmsim("scene.yaml", "--no-output", folder=folder)
        if code == 0 and "nowhere" not in said and "never fires" not in said:
            return None
    return said


def run_command(example, folder):
    words = shlex.split(example)[1:]
    if words[0] == "apply" and words[1] == "sew_elements":  # darts of the file made here
        words[words.index("--at") + 1] = "2,14"
    code, said = gmsim(*words, folder=folder)
    applied = words[0] != "apply" or re.search(r": applied [1-9]", said)
    return None if code == 0 and applied else said


def check_usage(folder):
    count, problems = 0, []
    for path, block in usage_blocks():
        for example in examples(block):
            if example.startswith("gmsim "):
                wrong = run_command(example, folder)
            elif example.split(":")[0] in SCENE_KEYS:
                wrong = run_scene(example, folder)
            else:
                continue  # a piece of a rule file
            count += 1
            if wrong is not None:
                problems.append(f"{path}: {example}\n{wrong}")
    assert count > 30, f"only {count} examples were found"
    return problems


def check_help(folder):
    """An example of a help text may name files that are not there, and nothing else may be wrong with it."""
    problems = []
    _, top = gmsim("-h", folder=folder)
    commands = re.findall(r"^  ([a-z]+) {2,}\S", top[top.index("Subcommands:"):], re.M)
    assert len(commands) > 10, commands
    for command in [None, *commands]:
        _, text = gmsim(*([command] if command else []), "-h", folder=folder)
        for line in re.findall(r"^  (gmsim .*)$", text, re.M):
            example = re.split(r" {2,}| \| ", line)[0]
            words = shlex.split(example)
            if ">" in words:
                words = words[:words.index(">")]
            code, said = gmsim(*words[1:], folder=folder)
            missing = code == 3 or "cannot read" in said or "no such file" in said
            unknown_rule = "my_rule" in said or "thicken" in said
            if code != 0 and not missing and not unknown_rule:
                problems.append(f"gmsim {command or ''} -h: {example}\n{said}")
    return problems


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_files(folder)
        problems = check_usage(folder) + check_help(folder)
    print("\n\n".join(problems) or "every example works")
    return 1 if problems else 0


sys.exit(main())
