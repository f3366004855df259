"""Check the files of vectors and sequences, entry by entry."""
import json
import struct

from .pieces import Bad


def check_all(folder, key, check):
    """Check all entries under `key`; return their number, the counts by outcome, and the failures."""
    files = {path: json.loads(path.read_text(encoding="utf-8"))[key] for path in sorted(folder.glob("*.json"))}
    listed = [one for found in files.values() for one in found]
    by_id = {one["id"]: one for one in listed}
    total, failures = {"accepted": 0, "rejected": 0}, []
    if not listed:
        failures.append("no %s in %s" % (key, folder))
    if len(by_id) != len(listed):
        failures.append("%d %s have the id of another one" % (len(listed) - len(by_id), key))
    for path, found in files.items():
        counts = {"accepted": 0, "rejected": 0}
        if not found:
            failures.append("%s: no %s" % (path.name, key))
        for one in found:
            try:
                counts[check(one, by_id)] += 1
            except Bad as why:
                failures.append("%s: %s" % (one["id"], why))
            except (KeyError, TypeError, ValueError, AttributeError, IndexError, struct.error) as why:
                failures.append("%s: malformed: %s: %s" % (one["id"], type(why).__name__, why))
        print("%s: %d accepted, %d rejected, %d wrong"
              % (path.name, counts["accepted"], counts["rejected"], len(found) - sum(counts.values())))
        for outcome in total:
            total[outcome] += counts[outcome]
    return len(listed), total, failures
