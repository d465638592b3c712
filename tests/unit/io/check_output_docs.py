# SPDX-License-Identifier: MIT
"""check_output_docs.py WRITE_TRAJECTORY_SAMPLES docs/output.md: every Python block of the page runs, on a file
`run.vtkhdf`. Blocks that import a module which is not installed are passed over, and named."""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def main():
    program, page = sys.argv[1:]
    blocks = re.findall(r"^```python\n(.*?)^```$", pathlib.Path(page).read_text(), re.M | re.S)
    if len(blocks) < 5:
        sys.exit(f"FAILED: {len(blocks)} Python blocks in {page}")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, folder], check=True)
        shutil.copy(pathlib.Path(folder) / "sheet.vtkhdf", pathlib.Path(folder) / "run.vtkhdf")
        os.chdir(folder)
        for block in blocks:
            missing = [m for m in re.findall(r"^import (\w+)", block, re.M) if not importlib.util.find_spec(m)]
            if missing:
                print(f"passed over: needs {', '.join(missing)}")
                continue
            ran = subprocess.run([sys.executable, "-c", block], capture_output=True, text=True)
            if ran.returncode != 0:
                sys.exit(f"FAILED:\n{block}\n{ran.stderr}")
    print(f"{len(blocks)} blocks")


main()
