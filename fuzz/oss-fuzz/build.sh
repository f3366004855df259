#!/bin/bash -eu
# Builds the fuzz targets for OSS-Fuzz and ClusterFuzzLite, which run this script in their container as
# $SRC/build.sh, and writes them to $OUT with their seeds, dictionaries and options. fuzz/oss-fuzz/check
# tests the result.
set -o pipefail
cd "$SRC/ads-cnc"

engine="${FUZZING_ENGINE:-libfuzzer}"
if [ "$engine" != libfuzzer ]; then
    echo "build.sh: the targets need libfuzzer, not $engine" >&2
    exit 1
fi

case "${ARCHITECTURE:-x86_64}" in
    x86_64 | aarch64) triple="${ARCHITECTURE:-x86_64}-unknown-linux-gnu" ;;
    i386) triple=i686-unknown-linux-gnu ;;
    *) echo "build.sh: unknown architecture: $ARCHITECTURE" >&2; exit 1 ;;
esac

# The build of libFuzzer reads the flags for C and C++ from the environment, unless
# CUSTOM_LIBFUZZER_PATH names the libFuzzer of the container. cargo fuzz adds its own flags to RUSTFLAGS;
# FUZZ_RUSTFLAGS adds more, as in fuzz/nightly.
target_dir="${CARGO_TARGET_DIR:-$WORK/target}"
profile=release
fuzz() {
    CARGO_PROFILE_RELEASE_DEBUG=line-tables-only \
        RUSTFLAGS="${RUSTFLAGS:-}${FUZZ_RUSTFLAGS:+ $FUZZ_RUSTFLAGS}" cargo fuzz build --fuzz-dir fuzz \
        --features libfuzzer --release --debug-assertions --target "$triple" \
        --target-dir "$target_dir" --sanitizer "$@"
}
case "${SANITIZER:-address}" in
    address) fuzz address ;;
    memory) fuzz memory --build-std ;;
    # Rust has no UndefinedBehaviorSanitizer; debug assertions are the closest replacement.
    none | undefined) fuzz none ;;
    # For coverage, the container replaces `cargo fuzz` with a script that ignores features. This command
    # does the same as the script, but with features: a build without optimisation.
    coverage)
        profile=debug
        RUSTFLAGS="${RUSTFLAGS:---cfg fuzzing -Cinstrument-coverage}" cargo build -p ads-cnc-fuzz \
            --bins --features libfuzzer --target "$triple" --target-dir "$target_dir" ;;
    *) echo "build.sh: unknown sanitizer: $SANITIZER" >&2; exit 1 ;;
esac

for source in fuzz/fuzz_targets/*.rs; do
    target="$(basename "$source" .rs)"
    cp "$target_dir/$triple/$profile/$target" "$OUT/"
    seeds=()
    for folder in "corpus/$target" "regressions/$target"; do
        if [ -d "fuzz/$folder" ]; then seeds+=("$folder"); fi
    done
    # If the archive exists, zip would add to it.
    rm -f "$OUT/${target}_seed_corpus.zip"
    (cd fuzz && zip -qrX "$OUT/${target}_seed_corpus.zip" "${seeds[@]}")
    # A fuzzer finds its dictionary by the name of the target.
    dictionary="fuzz/dictionaries/${target%%_*}.dict"
    if [ -f "$dictionary" ]; then cp "$dictionary" "$OUT/$target.dict"; fi
    printf '[libfuzzer]\ntimeout = 10\nmalloc_limit_mb = 256\n' >"$OUT/$target.options"
done
