"""Writes Markdown tables."""

import statistics

# Our queries are compared with these: the best that double precision gets from Embree on such rays.
YARDSTICKS = {
    "coherent": "Embree, double callback, packets of 16",
    "scattered": "Embree, double callback, one by one",
}


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(head) + " |", "|---|" + "--:|" * (len(head) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def rounded(value: float) -> str:
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def marked(value: float, divisor: int) -> str:
    return ("~" if divisor > 1 else "") + rounded(value)


def plural(threads: str) -> str:
    return f"{threads} thread" + ("" if threads == "1" else "s")


# ---- CRT and POV-Ray ----------------------------------------------------------------------------


def povray_results(results: dict, prefix: str = "povray/") -> dict[str, dict]:
    return {
        part.removeprefix(prefix): result for part, result in results.items()
        if part.startswith(prefix)
    }


def povray_table(results: dict, prefix: str = "povray/") -> str:
    scenes = povray_results(results, prefix)
    if not scenes:
        return ""
    threads = list(next(iter(scenes.values()))["threads"])
    head = ["scene"]
    for count in threads:
        head += [f"CRT, {count}", f"POV-Ray, {count}", "ratio"]
    head += ["gain", "apart"]
    rows = []
    for name, result in scenes.items():
        row = [f"`{name}`"]
        for count in threads:
            times = result["threads"][count]
            row += [marked(times["crt"], result["crt_divisor"]),
                    marked(times["povray"], result["pov_divisor"]),
                    f"**{rounded(times['ratio'])}**"]
        gain = result["threads"][threads[0]]["crt"] / result["threads"][threads[-1]]["crt"]
        rows.append(row + [f"{gain:.2f}", f"{result['different_pixels']:.3%}"])
    return f"{table(head, rows)}\n\n{povray_summary(scenes, threads)}"


def scene_list(results: dict, prefix: str = "povray/") -> str:
    return "\n".join(
        f"- `{name}`: {result['about']}" for name, result in povray_results(results, prefix).items()
    )


def bsp_table(results: dict) -> str:
    return povray_table(results, "povray-bsp/")


def povray_summary(scenes: dict, threads: list[str]) -> str:
    first = next(iter(scenes.values()))
    lines = [f"Seconds of tracing at {first['width']} x {first['height']} pixels, medians of"
             f" {min(s['rounds'] for s in scenes.values())} to"
             f" {max(s['rounds'] for s in scenes.values())} rounds;"
             f" the ratio is the median of each round's. The heads name the number of threads:"
             f" {' or '.join(threads)}."]
    for count in threads:
        ratios = {name: result["threads"][count]["ratio"] for name, result in scenes.items()}
        least = min(ratios, key=ratios.get)
        lines.append(f"On {plural(count)} the median of all ratios is"
                     f" {rounded(statistics.median(ratios.values()))},"
                     f" the least {rounded(ratios[least])} (`{least}`).")
    lines.append(
        f"*gain* is what CRT gains by {threads[-1]} threads, *apart* the share of pixels"
        f" that differ."
    )
    return " ".join(lines)


# ---- threads ------------------------------------------------------------------------------------


def threads_table(results: dict) -> str:
    scenes = {
        part.removeprefix("threads/"): result for part, result in results.items()
        if part.startswith("threads/")
    }
    if not scenes:
        return ""
    count = next(iter(scenes.values()))["threads"]
    head = [
        "scene", "1 thread", f"{count} processes at once, each", f"{count} threads", "gain",
        "possible gain",
    ]
    gains = {name: result["alone"] / result["together"] for name, result in scenes.items()}
    limits = {name: count * result["alone"] / result["at_once"] for name, result in scenes.items()}
    rows = [[f"`{name}`", *(rounded(result[times]) for times in ("alone", "at_once", "together")),
             f"**{gains[name]:.2f}**", f"{limits[name]:.2f}"] for name, result in scenes.items()]
    shares = [gains[name] / limits[name] for name in scenes]
    least = min(gains, key=gains.get)
    rounds = [result["rounds"] for result in scenes.values()]
    return (f"{table(head, rows)}\n\nSeconds of tracing, the least of {min(rounds)} to"
            f" {max(rounds)} rounds. The median of the gains is"
            f" {statistics.median(gains.values()):.2f}, the least {gains[least]:.2f} (`{least}`);"
            f" of the possible gain they are {min(shares):.0%} to {max(shares):.0%}, in the median"
            f" {statistics.median(shares):.0%}.")


# ---- ray queries and Embree ---------------------------------------------------------------------


def embree_columns(rows: list[dict]) -> dict[tuple, dict[str, dict]]:
    """Returns what was measured, by (spheres, flow) and then by name."""
    columns: dict[tuple, dict[str, dict]] = {}
    for row in rows:
        columns.setdefault((row["spheres"], row["flow"]), {})[row["name"]] = row
    return columns


def speed(row: dict) -> str:
    return rounded(row["rays"] / statistics.median(row["seconds"]) / 1e6)


def ratio_to_yardstick(column: dict[str, dict], flow: str, name: str) -> str:
    query = name.split(":")[0]
    yardstick = column[f"{query}: {YARDSTICKS[flow]}"]
    return rounded(
        statistics.median(y / own for y, own in zip(yardstick["seconds"], column[name]["seconds"]))
    )


def embree_table(results: dict) -> str:
    if "embree" not in results:
        return ""
    columns = embree_columns(results["embree"]["rows"])
    names = list(max(columns.values(), key=len))
    head = [""] + [f"{spheres:.0e}, {flow}".replace("e+0", "e") for spheres, flow in columns]
    speeds = [
        [name] + [speed(column[name]) if name in column else "" for column in columns.values()]
        for name in names
    ]
    ratios = [[name] + [f"**{ratio_to_yardstick(column, flow, name)}**" if name in column else ""
                        for (_, flow), column in columns.items()]
              for name in names if "CRT" in name]
    return ("Millions of rays in a second of one processor, by the number of spheres:\n\n"
            + table(head, speeds)
            + "\n\nCRT's speed over that of Embree with the double-precision callback (packets for"
              " coherent rays,"
            " one by one for scattered ones):\n\n" + table(head, ratios))


def meshes_table(results: dict) -> str:
    if "meshes" not in results:
        return ""
    columns: dict[tuple, dict[str, dict]] = {}
    for row in results["meshes"]["rows"]:
        columns.setdefault((row["triangles"], row["flow"]), {})[row["name"]] = row
    names = list(next(iter(columns.values())))
    head = [""] + [f"{triangles:.0e}, {flow}".replace("e+0", "e") for triangles, flow in columns]
    speeds = [[name] + [speed(column[name]) for column in columns.values()] for name in names]
    ratios = [
        [f"{name}, over {columns[next(iter(columns))][name]['yardstick']}"]
        + [f"**{rounded(column[name]['ratio'])}**" for column in columns.values()]
        for name in names if "CRT" in name
    ]
    return ("Millions of rays in a second of one processor, by the number of triangles:\n\n"
            + table(head, speeds)
            + "\n\nSpeed as a share of that of a yardstick:\n\n" + table(head, ratios))


# ---- cost curves --------------------------------------------------------------------------------


def curves_by_name(results: dict) -> dict[str, dict[int, dict]]:
    curves: dict[str, dict[int, dict]] = {}
    for row in results.get("curves", {}).get("rows", []):
        curves.setdefault(row["curve"], {})[row["n"]] = row
    return curves


def curves_table(results: dict) -> str:
    curves = curves_by_name(results)
    if not curves:
        return ""
    sizes = sorted({n for points in curves.values() for n in points})

    def line(n: int, value) -> list[str]:
        return [str(n)] + [
            rounded(value(points[n])) if n in points else "" for points in curves.values()
        ]

    times = [line(n, lambda point: statistics.median(point["nanoseconds"])) for n in sizes]
    prepare = [line(n, lambda point: point["prepare_seconds"]) for n in sizes]
    head = ["N", *curves]
    about = "\n".join(
        f"- {name}: {next(iter(points.values()))['about']}" for name, points in curves.items()
    )
    return (f"{about}\n\nNanoseconds a ray, one thread:\n\n{table(head, times)}"
            f"\n\nSeconds of one processor to prepare the scene (all threads"
            f" together):\n\n{table(head, prepare)}")


def all_tables(results: dict) -> str:
    makers = (povray_table, bsp_table, threads_table, embree_table, meshes_table,
              curves_table)
    return "\n\n".join(filter(None, (make(results) for make in makers)))
