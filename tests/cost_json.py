"""What `assay cost` says adds up, and leaving an item out never costs more operations or memory.

usage: cost_json.py ASSAY FILE SCENE [WORDS...]
"""
import json
import subprocess
import sys

assay, path, *words = sys.argv[1:]
said = subprocess.run([assay, "cost", *words, "--json", path], check=True, capture_output=True, text=True).stdout
with open(path, encoding="utf-8") as file:
    cost = json.load(file)
bytes_in_all = sum(array["bytes"] for array in cost["arrays"])
flops = sum(term["flop_per_particle_step"] for term in cost["terms"])
wrong = []
if abs(bytes_in_all - cost["bytes_per_particle"] * cost["particles"]) > 0.5:
    wrong.append(f"arrays have {bytes_in_all} bytes")
if abs(flops - cost["flop_per_particle_step"]) > 1e-9 * flops:
    wrong.append(f"terms have {flops} operations")
if not cost["ns_per_particle_step"] > 0 or not cost["without"]:
    wrong.append("nothing was timed, or nothing can be left out")
for item in cost["without"]:
    for key in ("flop_per_particle_step", "bytes_per_particle"):
        if item["runs"] and not item[key] <= cost[key]:
            wrong.append(f"without {item['name']}: {key} {item[key]} instead of {cost[key]}")
    if all(item[key] == cost[key] for key in ("flop_per_particle_step", "bytes_per_particle")):
        wrong.append(f"without {item['name']} nothing is saved")
    if not item["runs"] or f"  {item['name']} " not in said:
        wrong.append(f"without {item['name']} it does not run, or it is not printed")
for unit in ("B/particle", "flop/p-step", "ns/p-step"):
    if unit not in said:
        wrong.append(f"no {unit} in the table")
print("\n".join(wrong) or f"{len(cost['without'])} items can be left out")
sys.exit(bool(wrong))
