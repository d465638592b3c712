#!/bin/sh
# SPDX-License-Identifier: MIT
# with_python.sh "vtk h5py" COMMAND ARGS...: runs a command with GMSIM_PYTHON set to a Python that has
# these modules. "{python}" as the command stands for that Python. Exit code 77 (ctest: skipped) when
# there is none.
modules=$1
shift
root=$(cd "$(dirname "$0")/../.." && pwd)
for python in "$GMSIM_PYTHON" "$root"/build/venv*/bin/python python3; do
  [ -n "$python" ] || continue
  if "$python" -c "import $(echo "$modules" | tr ' ' ',')" 2>/dev/null; then
    export GMSIM_PYTHON="$python"
    if [ "$1" = "{python}" ]; then
      shift
      exec "$python" "$@"
    fi
    exec "$@"
  fi
done
echo "skipped: no Python has $modules; ./gmsim.sh test makes one, or name yours in GMSIM_PYTHON"
exit 77
