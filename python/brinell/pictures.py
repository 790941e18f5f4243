"""What pictures of fits and of studies share: axes with ticks that have room, and files."""

from __future__ import annotations

import collections
import io
import re
import zlib
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from . import temporary


def logarithmic(axes: Any, which: str) -> None:
    """Make the axis `which`, "x" or "y", of what is drawn logarithmic, with plain numbers."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    axes.set(**{f"{which}scale": "log"})
    axis = getattr(axes, f"{which}axis")
    low, high = getattr(axes, f"get_{which}lim")()
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 1e2 * low else (1.0,)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def save(figure: Any, path: str | Path) -> None:
    """Write a figure whole, with the same bytes each time; an .svg without what nobody sees."""
    import matplotlib

    if Path(path).suffix != ".svg":
        with temporary.draft(Path(path)) as whole:
            figure.savefig(whole)
        return
    drawn = io.StringIO()
    # text stays text; a curve has the points that can be seen
    with matplotlib.rc_context(
        {
            "font.sans-serif": ["DejaVu Sans", "Verdana"],
            "path.simplify_threshold": 0.25,
            "svg.fonttype": "none",
            "svg.hashsalt": "brinell",
        }
    ):
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    with temporary.draft(Path(path)) as whole:
        whole.write_text(compact(drawn.getvalue()), encoding="utf-8")


def compact(svg: str) -> str:
    """The same picture of matplotlib's in hundredths of a point: an element a line, each style
    written once, no names and groups that nothing refers to."""
    for prefix, space in (("", "2000/svg"), ("xlink", "1999/xlink")):
        ElementTree.register_namespace(prefix, f"http://www.w3.org/{space}")
    root = ElementTree.fromstring(svg)
    shorten(root, set(re.findall(r"#([\w-]+)", svg)))
    elements = list(root.iter())
    styles = collections.Counter(element.get("style") for element in elements)
    often = [style for style, count in styles.items() if style and count > 1]
    # a page may have several pictures in it
    mark = zlib.crc32("".join(often).encode()) % 1000
    classes = {style: f"s{mark}-{index}" for index, style in enumerate(often)}
    for element in elements:
        if element.get("style") in classes:
            element.set("class", classes[element.attrib.pop("style")])
        elif element.tag.endswith("}style"):
            rules = (f".{name}{{{style}}}" for style, name in classes.items())
            element.text = "\n".join((element.text or "", *rules))
    return ElementTree.tostring(root, encoding="unicode").replace("><", ">\n<") + "\n"


def shorten(element: ElementTree.Element, used: set[str]) -> None:
    """Shorten an element and what is in it; others refer to the names `used`."""
    kept: list[ElementTree.Element] = []
    for child in element:
        kind = child.tag.rpartition("}")[2]
        shorten(child, used)
        if kind == "g" and not child.attrib:
            kept += child
        elif kind != "metadata":
            kept.append(child)
    element[:] = kept = joined(kept)
    element.text, element.tail = (element.text or "").strip() or None, None
    name = element.attrib.pop("id", "")
    references = {key: value for key, value in element.items() if "#" in value and key != "style"}
    others = {key: short(value) for key, value in element.items() if key not in references}
    element.attrib = references | {key: value for key, value in others.items() if value}
    if name in used:
        element.set("id", name)
    # what the marks of a curve have in common is their group's
    styles = {child.get("style") if child.tag.endswith("}use") else None for child in kept}
    if len(kept) > 1 and len(styles) == 1 and None not in styles:
        for child in kept:
            element.set("style", child.attrib.pop("style"))


def joined(elements: list[ElementTree.Element]) -> list[ElementTree.Element]:
    """The elements, with straight lines of one style as one path: those in axes, such as a grid,
    and neighbours, such as a frame."""
    kept: list[ElementTree.Element] = []
    lines: dict[tuple[str, str], ElementTree.Element] = {}
    for element in elements:
        way = element.get("d", "")
        key = element.get("clip-path", ""), element.get("style", "")
        is_line = key[1] != "" and len(way.split()) == 5 and "id" not in element.attrib
        line = lines.get(key)
        if is_line and line is not None and (key[0] or kept[-1] is line):
            line.set("d", f"{line.get('d')} {way}")
            continue
        kept.append(element)
        if is_line:
            lines[key] = element
    return kept


def short(value: str) -> str:
    """The value of an attribute with two decimals, without repeated letters of straight lines."""

    def rounded(number: re.Match[str]) -> str:
        return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")

    value = re.sub(r"rotate\(-?0 [^)]*\)", "", " ".join(value.split()))
    value = re.sub(r"-?\d+\.\d{3,}(e-?\d+)?", rounded, value)
    return value if "C" in value or "Q" in value else value.replace(" L ", " ")
