#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Formats every .h and .cpp file; with --check it changes none, names those that differ and fails.
set -euo pipefail
cd "$(dirname "$0")/.."

format=$(command -v clang-format-14 || command -v clang-format)
mode=(-i)
if [ "${1:-}" = --check ]; then
  mode=(--dry-run --Werror)
fi
find mesh lighting io tools tests benchmarks -name '*.h' -o -name '*.cpp' | sort | xargs --no-run-if-empty "$format" "${mode[@]}"
