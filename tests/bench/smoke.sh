#!/bin/sh
# Runs smoke.py by a Python that has NumPy. Where there is none it ends with 77, which CTest takes
# for skipped.
for python in /usr/bin/python3 python3; do
  if "$python" -c 'import numpy' 2>/dev/null; then
    exec "$python" "$(dirname "$0")/smoke.py" "$@"
  fi
done
echo "SKIPPED: there is no Python with NumPy (Debian: python3 and python3-numpy)"
exit 77
