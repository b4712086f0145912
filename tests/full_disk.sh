#!/usr/bin/env bash
# Runs into disks that are full sooner or later, over the files of an earlier run:
#
#   bash tests/full_disk.sh TRACE_PATH [DISKS]
#
# The run must end with status 5 and a sentence, leave either all files of the earlier run or all of its own and nothing
# half-written, and go on from there to the files of a run left alone: elsewhere, and in place once there is room.
# Each disk is a tmpfs in a mount namespace of this script; where that is not allowed it ends with status 77.
set -euo pipefail
program=$(realpath "${1:?the program}")
disks=${2:-12}

if [[ -z ${ARCWALL_OWN_MOUNTS:-} ]]; then
  own=(unshare --mount)
  can_mount() { "${own[@]}" mount -t tmpfs tmpfs /tmp 2>/dev/null; }
  can_mount || own+=(--map-root-user)  # who is not root is so in a namespace
  if ! can_mount; then
    echo "skipped: no file system may be mounted here"
    exit 77
  fi
  exec env ARCWALL_OWN_MOUNTS=1 "${own[@]}" bash "$0" "$@"
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scratch=$(mktemp -d)
trap 'umount "$scratch/disk" 2>/dev/null || true; rm -rf "$scratch"' EXIT
cd "$scratch"

fail() {
  echo "error: with room for $room kB: $1" >&2
  exit 1
}

arguments=("$root/examples/channel.toml" --set member.column.elements=8)
options=(--quiet --checkpoint-pause 0)
# The files that are put in place together, and the checkpoint apart.
together=(path.csv contacts.csv events.json events.txt branches.json report.html deck.toml result.json)
sums() { (cd "$1" && sha256sum "${together[@]}"); }
same_files() { diff -r --exclude=result.json whole "$1" >&2 || fail "$2"; }

"$program" run "${arguments[@]}" "${options[@]}" --out whole
whole_kb=$(du -sk whole | cut -f1)

# try_with ROOM: over an earlier run's three points, with ROOM kB left; counts what happened.
full=0
kept=0
try_with() {
  room=$1
  mkdir -p disk
  mount -t tmpfs -o "size=$((4 * whole_kb))k" tmpfs disk
  "$program" run "${arguments[@]}" "${options[@]}" --max-points 3 --out disk/run 2>/dev/null || [[ $? == 6 ]]
  local earlier status=0
  earlier=$(sums disk/run)
  local left
  left=$(df --output=avail disk | tail -n 1)
  head -c "$((left - room))K" /dev/zero >disk/filler

  "$program" run "${arguments[@]}" "${options[@]}" --out disk/run 2>said || status=$?
  if [[ $status != 0 ]]; then
    full=$((full + 1))
    [[ $status == 5 ]] || fail "the run ended with status $status"
    grep -q '^error: disk/run.*: No space left on device$' said || fail "it said: $(cat said)"
    [[ -z $(find disk/run -name '.*') ]] || fail "something is left half-written: $(find disk/run -name '.*')"
    if [[ $(sums disk/run) == "$earlier" ]]; then
      kept=$((kept + 1))
    else  # all were in place before the shapes found no room
      diff <(cd whole && sha256sum path.csv contacts.csv events.json events.txt branches.json report.html deck.toml) \
        <(sums disk/run | grep -v result.json) || fail "files of two runs are mixed"
    fi
    rm -rf elsewhere
    cp -r disk/run elsewhere
    "$program" resume elsewhere "${options[@]}" 2>/dev/null || fail "it does not go on elsewhere"
    same_files elsewhere "the run that went on elsewhere has other files"
    rm disk/filler
    "$program" resume disk/run "${options[@]}" 2>/dev/null || fail "it does not go on in place"
    same_files disk/run "the run that went on in place has other files"
  else
    same_files disk/run "a run that found room has other files"
  fi
  umount disk
}

for ((k = 0; k < disks; ++k)); do try_with $((k * (whole_kb + 50) / disks)); done
echo "$full of $disks disks full: status 5 and a sentence, all files of the earlier run kept ($kept) or all in place but" \
  "the shapes ($((full - kept))), and on to the files of a run left alone, elsewhere and in place"
[[ $full -gt 0 && $kept -gt 0 ]]
