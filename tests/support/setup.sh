# Sourced by the scripts that run tests: installs what they need, and says what it is doing while that takes long.
# Everything goes into places of the project's own (a virtual environment, node_modules, target/), but for Debian's packages,
# which are installed where the user is root and named where he is not.

# wedm_program ROOT: the program that a client is tested with, $WEDM, else what was built last.
wedm_program() {
    local built
    # shellcheck disable=SC2012
    built=$(ls -t "$1"/target/{release,debug}/wedm 2>/dev/null | head -n 1)
    printf '%s\n' "${WEDM:-${built:-$1/target/debug/wedm}}"
}

# Tries a command twice: a registry may stumble.
twice() { "$@" || { sleep 2; "$@"; }; }

# patiently WHAT COMMAND...: runs a command and says every half minute that it still runs.
patiently() {
    local what=$1 begin=$SECONDS status ticker
    shift
    (
        trap 'kill "$pause" 2>/dev/null; exit' TERM
        while kill -0 $$ 2>/dev/null; do
            sleep 30 &
            pause=$!
            wait "$pause"
            echo "   ... $what, $((SECONDS - begin)) s"
        done
    ) &
    ticker=$!
    "$@"
    status=$?
    kill "$ticker" 2>/dev/null
    wait "$ticker" 2>/dev/null
    return "$status"
}

# debian PACKAGE...: those that are not installed are; fails, and says which are missing, where that cannot be.
debian() {
    local package missing=()
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    if [ "$(id -u)" -ne 0 ] || ! command -v apt-get >/dev/null; then
        echo "missing, install them first: ${missing[*]}"
        return 1
    fi
    echo "== installing Debian's ${missing[*]}"
    local options=(-qq -o DPkg::Lock::Timeout=300)
    apt_install() {
        # The lists of the last hour are good enough.
        [ -n "$(find /var/lib/apt/lists -maxdepth 1 -name '*Packages*' -mmin -60 2>/dev/null)" ] ||
            timeout 300 apt-get "${options[@]}" update >/dev/null || return 1
        DEBIAN_FRONTEND=noninteractive timeout 900 apt-get "${options[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null && return 0
        # Lists that are too old name packages that are gone.
        timeout 300 apt-get "${options[@]}" update >/dev/null
        return 1
    }
    patiently "installing packages" twice apt_install
}

# python_environment FOLDER REQUIREMENTS [ARGUMENTS OF A SECOND pip install]: a virtual environment that holds just what the file
# says. The file's own text is kept in it as the mark of what is installed.
python_environment() {
    local folder=$1 requirements=$2
    shift 2
    if ! python3 -c 'import ensurepip, venv' 2>/dev/null; then
        debian python3 python3-venv || return 1
    fi
    python3 -c 'import sys; assert sys.version_info >= (3, 11)' 2>/dev/null || {
        echo "Python 3.11 or later is needed"
        return 1
    }
    cmp -s "$requirements" "$folder/installed.txt" && return 0
    echo "== installing $requirements into $folder"
    rm -rf "$folder"
    mkdir -p "$(dirname "$folder")"
    python3 -m venv "$folder" || return 1
    local pip=(timeout 600 "$folder/bin/pip" install --quiet --disable-pip-version-check)
    patiently "installing Python packages" twice "${pip[@]}" -r "$requirements" || return 1
    [ $# -eq 0 ] || twice "${pip[@]}" "$@" || return 1
    cp "$requirements" "$folder/installed.txt"
}

# counts_of_pytest PYTHON REPORT STATUS: the last line of a run of pytest, from its report in JUnit's form; fails with the run.
counts_of_pytest() {
    "$1" - "$2" "$3" <<'PYTHON'
import sys
import xml.etree.ElementTree as tree

report, status = sys.argv[1], int(sys.argv[2])
try:
    suite = tree.parse(report).getroot().find("testsuite")
    count = {key: int(suite.get(key)) for key in ("tests", "failures", "errors", "skipped")}
except (OSError, tree.ParseError):
    count = {"tests": 1, "failures": 1, "errors": 0, "skipped": 0}
failed = count["failures"] + count["errors"]
if status and not failed:
    failed, count["tests"] = 1, count["tests"] + 1
print(f"{count['tests'] - failed - count['skipped']} passed, {failed} failed, {count['skipped']} skipped")
sys.exit(1 if failed else 0)
PYTHON
}
