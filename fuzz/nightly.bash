# shellcheck shell=bash disable=SC2154 # the variables are those of fuzz/nightly
# The library of fuzz/nightly: building and running targets, evaluating logs, printing tables.

# The sources whose change voids the recorded executions of a target: those of its laws and of the code under
# test. The list omits seeds, dictionaries and the replay, because they do not change what a target checks.
SOURCES=(codec/Cargo.toml codec/src codec/tests/common fuzz/Cargo.toml fuzz/src fuzz/fuzz_targets
    ':!fuzz/src/seeds*' ':!fuzz/src/dictionary.rs' ':!fuzz/src/replay.rs' ':!*.md')
CODEC_SOURCES=("${SOURCES[@]}" ':!fuzz/src/bodies/tools')
TOOL_SOURCES=("${SOURCES[@]}" conformance/src conformance/tests/common conformance/tests/program spec-vectors/src
    spec-vectors/data)

# Builds the targets with a sanitizer. Each sanitizer has its own folder, so that builds do not replace each other.
build() {
    local sanitizer="$1" name names=("") features
    [ ${#chosen[@]} -eq 0 ] || names=("${chosen[@]}")
    for name in "${names[@]}"; do
        # A target of the codec does not need the suite, whose build takes most of the time.
        features=(--features libfuzzer)
        [ -z "$name" ] || needs_tools "$name" || features+=(--no-default-features)
        # Debug information for the lines in backtraces.
        CARGO_PROFILE_RELEASE_DEBUG=line-tables-only \
            RUSTFLAGS="${RUSTFLAGS:-}${FUZZ_RUSTFLAGS:+ $FUZZ_RUSTFLAGS}" cargo "+$toolchain" fuzz build \
            --fuzz-dir fuzz "${features[@]}" --release --debug-assertions \
            --sanitizer "$sanitizer" --target-dir "$target_dir/fuzz-$sanitizer" ${name:+"$name"} ||
            broken "building the targets failed (sanitizer: $sanitizer)"
    done
    [ -z "$record" ] || is_clean || broken "the sources changed during the build"
}

# Whether the target needs the feature `tools`.
needs_tools() { grep -q '"tools"' <<<"$(sed -n "/^name = \"$1\"/,/^required-features/p" fuzz/Cargo.toml)"; }

binary() { echo "$target_dir/fuzz-$2/$triple/release/$1"; }

# Calls a function for each target, in parallel up to the number of jobs.
each() {
    local running=0
    for target in "${targets[@]}"; do
        if [ "$running" -ge "$jobs" ]; then
            wait -n || broken "$1 failed"
            running=$((running - 1))
        fi
        "$1" "$target" &
        running=$((running + 1))
    done
    for ((; running > 0; running--)); do
        wait -n || broken "$1 failed"
    done
}

# Prints the existing folders with inputs of a target, the committed folders first.
inputs() {
    local folder
    for folder in "fuzz/corpus/$1" "fuzz/regressions/$1" "$corpus/$1"; do
        if [ -d "$folder" ]; then realpath "$folder"; fi
    done | awk '!seen[$0]++'
}

# Prints the options of a target: its dictionary, and the maximum length of an input.
options() {
    local dictionary="fuzz/dictionaries/${1%%_*}.dict" folders
    if [ -f "$dictionary" ]; then echo "-dict=$dictionary"; fi
    mapfile -t folders < <(inputs "$1")
    { echo "$MAX_LEN"; [ ${#folders[@]} -eq 0 ] || find "${folders[@]}" -type f -printf '%s\n'; } |
        sort -n | sed -n '$s/^/-max_len=/p'
}

# Runs libFuzzer with the options of every run, and a timeout in case it does not stop.
libfuzzer() {
    local program="$1" bound="$2"
    shift 2
    ASAN_OPTIONS="detect_odr_violation=0${ASAN_OPTIONS:+:$ASAN_OPTIONS}" \
        timeout -k 10 $((bound * 2 + 300)) "$program" "${LIMITS[@]}" \
        -stop_file="$output/stop" -print_final_stats=1 "$@"
}

files() { find "$@" -type f 2>/dev/null | wc -l; }
statistic() { sed -n "s/^stat::$2: *//p" "$1" | tail -n 1; }
# Prints the number of edges (cov) or features (ft) at the end of a log, and the increase over the initial
# inputs.
covered() {
    awk -v what="$2:" '/^#[0-9]+\t/ {
        for (i = 2; i < NF; i++) if ($i == what) { last = $(i + 1); if ($2 == "INITED") first = last }
    } END { printf "%d (+%d)", last, first ? last - first : 0 }' "$1"
}

fuzz_without() { fuzz "$1" none "$seconds"; }
fuzz_with_asan() { fuzz "$1" address "$asan_seconds"; }

# Runs a target once, unless the table of --record already has all its executions, and writes its log, a row for
# the summary and, with --record, a row of the table.
fuzz() {
    local target="$1" sanitizer="$2" bound="$3" log="$output/logs/$1.$2.log" status=0
    local found="$output/found/$target" findings="$output/findings/$sanitizer/$target"
    local options folders executions rate new took found_before start result=ok sources="" runs="$executions_max"
    mkdir -p "$found" "$findings"
    if [ -n "$record" ]; then
        sources="$(digest_of_sources "$target")"
        read -r executions took found_before < <(recorded "$sources" "$target" "$sanitizer")
        bound=$((bound - took)) runs="${runs:+$((runs - executions))}"
        if [ "$bound" -le 0 ] || [ "${runs:-1}" -le 0 ]; then
            [ "$found_before" -eq 0 ] || result=finding
            row "$target" "$target" "$sanitizer" 0 0 0 - - 0 "$found_before" "$result"
            say "$target, sanitizer $sanitizer: done before ($executions executions, $took s)"
            return
        fi
    fi
    mapfile -t options < <(options "$target")
    mapfile -t folders < <(inputs "$target")
    start="$EPOCHSECONDS"
    libfuzzer "$(binary "$target" "$sanitizer")" "$bound" "${options[@]}" \
        -max_total_time="$bound" ${runs:+"-runs=$runs"} -artifact_prefix="$findings/" \
        "$found" ${folders[@]+"${folders[@]}"} >"$log" 2>&1 || status=$?
    executions="$(statistic "$log" number_of_executed_units)"
    rate="$(statistic "$log" average_exec_per_sec)"
    new="$(statistic "$log" new_units_added)"
    if [ "$(files "$findings")" -gt 0 ]; then
        result=finding
    elif [ "$status" -ne 0 ]; then
        result="exit code $status"
    elif [ "${executions:-0}" -eq 0 ]; then
        result="executed nothing"
    fi
    if [ -n "$record" ] && [ "${executions:-0}" -gt 0 ]; then
        printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$sources" "${commit:0:10}" "$target" \
            "$sanitizer" "${executions:-0}" $((EPOCHSECONDS - start)) "$(files "$findings")" >>"$record"
    fi
    row "$target" "$target" "$sanitizer" "$bound" "${executions:-0}" "${rate:-0}" \
        "$(covered "$log" cov)" "$(covered "$log" ft)" "${new:-0}" "$(files "$findings")" "$result"
    say "$target, sanitizer $sanitizer: ${executions:-0} executions, $result"
}

# Prints the sources of a target, one per line.
sources_of() {
    if needs_tools "$1"; then printf '%s\n' "${TOOL_SOURCES[@]}"; else printf '%s\n' "${CODEC_SOURCES[@]}"; fi
}

# Prints a digest of the committed sources of a target without empty lines and lines with only a comment.
digest_of_sources() {
    local sources
    mapfile -t sources < <(sources_of "$1")
    git grep -hv -E '^[[:space:]]*(//.*|# .*)?$' "$commit" -- "${sources[@]}" | git hash-object --stdin | cut -c 1-10
}

# Begins the table, if it is empty, and stores the commit whose sources are built.
begin_record() {
    commit="$(git rev-parse HEAD)"
    is_clean || misused "--record names the commit of the sources, but they have uncommitted changes"
    [ -s "$record" ] || printf 'sources\tcommit\ttarget\tsanitizer\texecutions\tseconds\tfindings\n' >"$record"
}

# Whether the sources of the chosen targets are those of the commit.
is_clean() {
    local target sources
    for target in "${targets[@]}"; do
        mapfile -t sources < <(sources_of "$target")
        git diff --quiet "$commit" -- "${sources[@]}" || return 1
    done
}

# Prints the executions, seconds and findings in the table of --record for these sources.
recorded() {
    awk -F'\t' -v sources="$1" -v target="$2" -v sanitizer="$3" \
        '$1 == sources && $3 == target && $4 == sanitizer { executions += $5; seconds += $6; found += $7 }
        END { printf "%d %d %d\n", executions, seconds, found }' "$record"
}

row() {
    local name="$1"
    shift
    (IFS=$'\t'; echo "$*") >>"$output/rows/$name"
}
rows() { for target in "${targets[@]}"; do cat "$output/rows/$target"; done; }
# Prints the number of rows whose value in a column is not one of the given values.
other_than() {
    rows | awk -F'\t' -v column="$1" -v wanted="^($2)\$" '$column !~ wanted { n++ } END { print n + 0 }'
}

# Prints rows, of which the first is the header, as a Markdown table with aligned columns.
markdown() {
    awk -F'\t' '{
        for (i = 1; i <= NF; i++) { cell[NR, i] = $i; if (length($i) > width[i]) width[i] = length($i) }
        columns = NF
    } END {
        for (row = 1; row <= NR; row++) {
            line = "|"; rule = "|"
            for (i = 1; i <= columns; i++) {
                line = line sprintf(" %-" width[i] "s |", cell[row, i])
                dashes = sprintf("%" width[i] "s", ""); gsub(/ /, "-", dashes)
                rule = rule " " dashes " |"
            }
            print line
            if (row == 1) print rule
        }
    }'
}

# Prints the signature of a finding: the target, the kind of failure, and its location in the log. All
# inputs that cause the same failure have the same signature.
signature() {
    local what place
    what="$(basename "$3")"
    place="$(sed -n -e 's/.*panicked at \(.*\):$/\1/p' -e 's/^SUMMARY: \(.*\)/\1/p' \
        "$output/logs/$1.$2.log" | head -n 1)"
    echo "$1 ${what%%-*} ${place:-somewhere}"
}

# Prints one finding per line: target, sanitizer, path, signature. A failure that was found
# both with and without sanitizer is listed once.
list_findings() {
    local target sanitizer path
    for target in "${targets[@]}"; do
        for sanitizer in none address; do
            { find "$output/findings/$sanitizer/$target" -type f 2>/dev/null || true; } | sort |
                while read -r path; do
                    printf '%s\t%s\t%s\t%s\n' "$target" "$sanitizer" "$path" \
                        "$(signature "$target" "$sanitizer" "$path")"
                done
        done | awk -F'\t' '!seen[$4]++'
    done
}

# Prints the table and writes it to two files, with the commands that repeat each finding.
summary() {
    { printf 'target\tsanitizer\tseconds\texecutions\texec/s\tedges\tfeatures\tnew inputs\tfindings\tresult\n'
      rows; } >"$output/summary.tsv"
    list_findings >"$output/findings.tsv"
    {
        markdown <"$output/summary.tsv"
        printf '\n%s executions with %s; edges and features: %s.\n' \
            "$(rows | awk -F'\t' '{ n += $4 } END { print n + 0 }')" "$toolchain" \
            "number at the end of the run (increase over the initial inputs)"
        while IFS=$'\t' read -r target sanitizer path signature; do
            local fuzz="--fuzz-dir fuzz --features libfuzzer --sanitizer $sanitizer $target"
            printf '\n%s (%s)\n\n' "$signature" "$(basename "$path")"
            printf '    cargo +%s fuzz run %s %q -- %s\n' "$toolchain" "$fuzz" "$path" "${LIMITS[*]}"
            printf '    cargo +%s fuzz tmin %s %q\n' "$toolchain" "$fuzz" "$path"
        done <"$output/findings.tsv"
    } | tee "$output/summary.md"
    echo "results in $output"
}

# Lists the inputs that libFuzzer named, with the digest of their bytes as the name.
digests() { find "$1" -maxdepth 1 -type f 2>/dev/null | grep -E '/[0-9a-f]{40}$' || true; }

# Collects the inputs of the corpus and the new inputs that add coverage to the committed inputs. If the corpus
# is the committed one, collects those that add coverage to the inputs named by hand: keep_inputs replaces only
# inputs whose name is a digest.
minimise() {
    local target="$1" base into="$output/corpus/$1" path before options folders status=0
    base="$(mktemp -d)"
    mkdir -p "$into"
    if [ -d "fuzz/corpus/$target" ]; then cp -r "fuzz/corpus/$target/." "$base"; fi
    if committed; then digests "$base" | tr '\n' '\0' | xargs -0 -r rm; fi
    before="$(find "$base" -type f -printf '%f\n' | sort)"
    mapfile -t folders < <(inputs "$target")
    mapfile -t -O "${#folders[@]}" folders < <(echo "$output/found/$target")
    mapfile -t options < <(options "$target")
    libfuzzer "$(binary "$target" "$chosen_sanitizer")" 3600 "${options[@]}" -merge=1 "$base" \
        "${folders[@]}" >"$output/logs/$target.merge.log" 2>&1 || status=$?
    if [ "$status" -ne 0 ]; then
        say "$target: not minimised, see $output/logs/$target.merge.log"
        rm -rf "$base" "$into"
        return 0
    fi
    find "$base" -type f -printf '%f\n' | sort | comm -13 <(echo "$before") - |
        while read -r path; do mv "$base/$path" "$into/"; done
    rm -rf "$base"
    say "$target: $(files "$into") inputs in addition to the committed ones"
}

committed() { [ "$(realpath -m "$corpus")" = "$PWD/fuzz/corpus" ]; }

# Copies new inputs to the corpus. Minimised inputs replace the previous ones; in the committed corpus,
# inputs that were named by hand stay.
keep_inputs() {
    local from="$output/found/$1"
    mkdir -p "$corpus/$1"
    if [ -d "$output/corpus/$1" ]; then
        from="$output/corpus/$1"
        if committed; then digests "$corpus/$1"; else find "$corpus/$1" -type f; fi |
            tr '\n' '\0' | xargs -0 -r rm
    fi
    cp -r "$from/." "$corpus/$1"
}

# Prints a line for each target: its name, its family, and the number of its seeded defects.
seeded_defects() { cargo run --quiet --locked -p ads-cnc-fuzz --example targets; }

prove_target() {
    local number defects
    # Every target must also detect a panic and an endless loop.
    for number in panic hang; do prove "$1" "$number"; done
    defects="$(awk -F'\t' -v target="$1" '$1 == target { print $3 }' "$output/defects.tsv")"
    for ((number = 1; number <= ${defects:-0}; number++)); do prove "$1" "$number"; done
    [ "${defects:-0}" -gt 0 ] || row "$1" "$1" - "none seeded" - -
}

# Runs one target with one seeded defect. The defect is found only if the finding is a crash (for the defect
# `hang`, a timeout) and its input passes without the defect.
prove() {
    local target="$1" number="$2" log="$output/logs/$1.$2.log" scratch start took kind=crash
    local verdict program options folders executions bound=$((seconds > 0 ? seconds : asan_seconds))
    program="$(binary "$target" "$chosen_sanitizer")"
    scratch="$(mktemp -d)"
    mkdir "$scratch"/{found,artifacts}
    mapfile -t options < <(options "$target")
    if [ "$number" = hang ]; then
        kind=timeout
        options+=(-timeout=2)
    fi
    mapfile -t folders < <(inputs "$target")
    start="$EPOCHREALTIME"
    ADS_CNC_SEEDED_DEFECT="$number" libfuzzer "$program" "$bound" "${options[@]}" \
        -max_total_time="$bound" -artifact_prefix="$scratch/artifacts/" \
        "$scratch/found" ${folders[@]+"${folders[@]}"} >"$log" 2>&1 || true
    took="$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')"
    executions="$(statistic "$log" number_of_executed_units)"
    if [ "$(files "$scratch/artifacts" -name "$kind-*")" -gt 0 ]; then
        verdict=found
        find "$scratch/artifacts" -name "$kind-*" -exec "$program" "${LIMITS[@]}" {} + >>"$log" 2>&1 ||
            verdict="fails without the defect"
    elif [ "${executions:-0}" -gt 0 ]; then
        verdict="not found"
    else
        verdict=broken
        tail -n 20 "$log" >&2
    fi
    row "$target" "$target" "$number" "$verdict" "$took" "${executions:-0}"
    rm -rf "$scratch"
}

table_of_proofs() {
    { printf 'target\tdefect\tverdict\tseconds\texecutions\n'; rows; } | markdown
}
