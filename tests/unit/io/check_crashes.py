# SPDX-License-Identifier: MIT
"""check_crashes.py CRASH_TRAJECTORY kills|limits COUNT SEED: runs it, then has VTK read every recovered file."""

import pathlib
import subprocess
import sys
import tempfile

from check_vtkhdf import Failure, check_file


def main():
    program, mode, count, seed = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, mode, count, seed, folder], check=True)
        files = sorted(pathlib.Path(folder).glob("*.vtkhdf"))
        steps = sum(check_file(path, orders=1) for path in files)
    print(f"{len(files)} recovered files, {steps} steps, all read by VTK")


try:
    main()
except Failure as failure:
    sys.exit(f"FAILED: {failure}")
