"""The bill of materials of the program: its crates with versions, licenses and hashes, as CycloneDX 1.6."""

from __future__ import annotations

import json
import tomllib
import uuid
from typing import Any

from licenses import linked_crates
from platforms import ROOT

_CRATES_IO = "registry+https://github.com/rust-lang/crates.io-index"


def bill_of_materials(version: str, target: str) -> bytes:
    """The document for the program for `target`. The same crates give the same bytes."""
    crates = linked_crates(target)
    hashes = _hashes()
    components = [_component(crate, hashes) for crate in crates]
    program: dict[str, Any] = {
        "type": "application",
        "bom-ref": f"pkg:cargo/brinell@{version}",
        "name": "brinell",
        "version": version,
        "purl": f"pkg:cargo/brinell@{version}",
        "licenses": [{"expression": "MIT"}],
        "properties": [{"name": "target", "value": target}],
    }
    document = {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": program},
        "components": components,
        "dependencies": [{"ref": program["bom-ref"], "dependsOn": [it["bom-ref"] for it in components]}],
    }
    name = json.dumps(document, sort_keys=True)
    document["serialNumber"] = f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, name)}"
    return (json.dumps(document, indent=1, sort_keys=True) + "\n").encode()


def _component(crate: dict[str, Any], hashes: dict[tuple[str, str], str]) -> dict[str, Any]:
    name, version = crate["name"], crate["version"]
    purl = f"pkg:cargo/{name}@{version}"
    component: dict[str, Any] = {"type": "library", "bom-ref": purl, "name": name, "version": version, "purl": purl}
    # older crates separate the licenses of a choice by a slash, which is no SPDX expression
    component["licenses"] = [{"expression": crate["license"].replace("/", " OR ")}]
    if crate["source"] == _CRATES_IO:
        component["hashes"] = [{"alg": "SHA-256", "content": hashes[name, version]}]
    return component


def _hashes() -> dict[tuple[str, str], str]:
    """The hashes of the packed crates, according to Cargo.lock."""
    packages = tomllib.loads((ROOT / "Cargo.lock").read_text(encoding="utf-8"))["package"]
    return {(it["name"], it["version"]): it["checksum"] for it in packages if "checksum" in it}
