#!/bin/bash -eu
# Builds the fuzz targets for OSS-Fuzz and ClusterFuzzLite, which run this in their container as
# $SRC/build.sh, and leaves them in $OUT with their seeds, dictionaries and options. What it leaves is
# tried by check, beside this.
set -o pipefail
cd "$SRC/ads-cnc"

engine="${FUZZING_ENGINE:-libfuzzer}"
if [ "$engine" != libfuzzer ]; then
    echo "build.sh: the targets are made for libfuzzer, not for $engine" >&2
    exit 1
fi

case "${ARCHITECTURE:-x86_64}" in
    x86_64 | aarch64) triple="${ARCHITECTURE:-x86_64}-unknown-linux-gnu" ;;
    i386) triple=i686-unknown-linux-gnu ;;
    *) echo "build.sh: no architecture $ARCHITECTURE" >&2; exit 1 ;;
esac

# The flags for C and C++ are read from the environment by what builds libFuzzer, if it is built at
# all: CUSTOM_LIBFUZZER_PATH names the container's own. Those for Rust are added to by cargo fuzz, and
# by FUZZ_RUSTFLAGS as in fuzz/nightly.
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
    # There is none for Rust; the debug assertions are what comes near it.
    none | undefined) fuzz none ;;
    # The container's stand-in for `cargo fuzz` leaves out features. Not optimised, as there.
    coverage)
        profile=debug
        RUSTFLAGS="${RUSTFLAGS:---cfg fuzzing -Cinstrument-coverage}" cargo build -p ads-cnc-fuzz \
            --bins --features libfuzzer --target "$triple" --target-dir "$target_dir" ;;
    *) echo "build.sh: no sanitizer $SANITIZER" >&2; exit 1 ;;
esac

for source in fuzz/fuzz_targets/*.rs; do
    target="$(basename "$source" .rs)"
    cp "$target_dir/$triple/$profile/$target" "$OUT/"
    seeds=()
    for folder in "corpus/$target" "regressions/$target"; do
        if [ -d "fuzz/$folder" ]; then seeds+=("$folder"); fi
    done
    # zip would add to what is there.
    rm -f "$OUT/${target}_seed_corpus.zip"
    (cd fuzz && zip -qrX "$OUT/${target}_seed_corpus.zip" "${seeds[@]}")
    # Taken up by its name.
    dictionary="fuzz/dictionaries/${target%%_*}.dict"
    if [ -f "$dictionary" ]; then cp "$dictionary" "$OUT/$target.dict"; fi
    printf '[libfuzzer]\ntimeout = 10\nmalloc_limit_mb = 256\n' >"$OUT/$target.options"
done
