#!/bin/bash -eu
# The same build as for OSS-Fuzz.
exec "$SRC/ads-cnc/fuzz/oss-fuzz/build.sh"
