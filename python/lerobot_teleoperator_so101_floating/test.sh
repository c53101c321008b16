#!/bin/sh
# Tests the plug-in against LeRobot's own classes and a simulated bus: test.sh [--prepare | PYTEST ARGUMENT…]
#
# --prepare makes the environment, and tests nothing.
#
# Below target/lerobot it makes a virtual environment with LeRobot from PyPI, without the packages that take gigabytes and that
# no test computes with (torch above all; tests/stand_ins.py takes their places), the wheel of robot_dynamics, and this package. What the
# firmware's scene commands is computed by Rust.
#   ROBOT_DYNAMICS_WHEEL   a wheel to take in place of the one that python/test.py builds
#   SO101_FLOATING_SCENE   what the scene commands, in place of what the bin so101_floating prints
#   TABLES_WRITE=1         writes the tables of the guide's page in place of comparing them
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
work=${CARGO_TARGET_DIR:-$root/target}/lerobot
mkdir -p "$work"

python="$work/venv/bin/python"
stamp="$work/requirements.txt"
if ! [ -x "$python" ] || ! cmp -s "$here/tests/requirements.txt" "$stamp"; then
    rm -rf "$work/venv" "$stamp"
    python3 -m venv "$work/venv"
    "$python" -m pip install -q --disable-pip-version-check --no-deps "lerobot==0.4.4" "feetech-servo-sdk>=1,<2"
    "$python" -m pip install -q --disable-pip-version-check -r "$here/tests/requirements.txt" 2>"$work/pip.log" || {
        cat "$work/pip.log" >&2
        exit 1
    }
    cp "$here/tests/requirements.txt" "$stamp"
fi

if [ "${1:-}" = --prepare ]; then
    exit
fi

wheel=${ROBOT_DYNAMICS_WHEEL:-}
if [ -z "$wheel" ]; then
    wheel=$(python3 "$root/python/test.py" --build)
fi
# From a copy: a build leaves files beside the sources.
rm -rf "$work/package"
cp -R "$here" "$work/package"
"$python" -m pip install -q --disable-pip-version-check --no-deps --force-reinstall "$wheel" "$work/package"

scene=${SO101_FLOATING_SCENE:-}
if [ -z "$scene" ]; then
    scene=$work/scene.json
    (cd "$root" && cargo run -q --package host-reports --bin so101_floating) >"$scene"
fi
cd "$here"
SO101_FLOATING_SCENE="$scene" HF_HOME="$work/huggingface" \
    exec "$python" -m pytest -p no:cacheprovider "$@"
