"""Markdown tables."""

import statistics


def seconds(value: float) -> str:
    return f"{value:.3g}"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def marked(value: float, divisor: int) -> str:
    return ("~" if divisor > 1 else "") + seconds(value)


def povray_results(results: dict) -> dict[str, dict]:
    return {part.removeprefix("povray/"): result for part, result in results.items() if part.startswith("povray/")}


def povray_table(results: dict) -> str:
    scenes = povray_results(results)
    if not scenes:
        return ""
    threads = list(next(iter(scenes.values()))["threads"])
    head = ["scene"]
    for count in threads:
        head += [f"crt, {count} thr.", "povray", "ratio"]
    rows = []
    for name, result in scenes.items():
        row = [f"{name}: {result['about']}"]
        for count in threads:
            times = result["threads"][count]
            row += [marked(times["crt"], result["crt_divisor"]), marked(times["povray"], result["pov_divisor"]),
                    f"**{times['ratio']:.3g}**"]
        rows.append(row + [f"{result['different_pixels']:.2%}"])
    return table(head + ["pixels apart"], rows) + "\n\n" + povray_summary(scenes, threads)


def povray_summary(scenes: dict, threads: list[str]) -> str:
    lines = []
    for count in threads:
        ratios = {name: result["threads"][count]["ratio"] for name, result in scenes.items()}
        least = min(ratios, key=ratios.get)
        lines.append(f"On {count} thread{'s' if count != '1' else ''} the median of the ratios is "
                     f"{statistics.median(ratios.values()):.3g}, the least {ratios[least]:.3g} ({least}).")
    return "\n".join(lines)


def all_tables(results: dict) -> str:
    return "\n\n".join(filter(None, [povray_table(results)]))
