# SPDX-License-Identifier: BSD-3-Clause
"""Makes one archive of substrate folders, as a data repository takes it: surfaces, manifests, certificates, a report and a preview of each, licence,
checksums, and the metadata that Zenodo reads.

Run it with ./cactus pack. The same folders give the same bytes.
"""

import argparse
import html
import json
import os
import re
import shutil
import sys
import tempfile
import zipfile

from substrate_folder import Refusal, changed_files, citation, ended, is_as_written, manifest_path, read_manifest, sha256

TIME = (1980, 1, 1, 0, 0, 0)  # the first that an archive can have
FILE_MODE, FOLDER_MODE = 0o100644, 0o040755
PREVIEW_TRIANGLES = 200_000  # some MB
KEYWORDS = ["white matter", "axons", "diffusion MRI", "Monte Carlo simulation", "synthetic substrate", "CACTUS"]


def arguments():
    parser = argparse.ArgumentParser(prog="./cactus pack", description=__doc__.split("\n\n", maxsplit=1)[0].replace("\n", " "))
    parser.add_argument("folders", nargs="+", metavar="FOLDER", help="a substrate folder, or its manifest.json")
    parser.add_argument("--creator", action="append", required=True, metavar="'FAMILY, GIVEN'", help="who has made the substrates and publishes them; once for each")
    parser.add_argument("--output", default="cactus-substrates.zip", metavar="FILE.zip", help="archive to write, which must not exist (default: %(default)s)")
    parser.add_argument("--title", help="of the data set (default: of the folders' names)")
    parser.add_argument("--version", default="1.0.0", help="of the data set (default: %(default)s)")
    parser.add_argument("--licence", default="CC-BY-4.0", metavar="SPDX", help="of the data, by its name in the list of SPDX (default: %(default)s)")
    parser.add_argument("--allow-uncertified", action="store_true", help="take substrates that are not certified, too")
    return parser.parse_args()


def checked(wanted):
    """Throws Refusal for words that cannot be."""
    for creator in wanted.creator:
        if not re.fullmatch(r"[^,;]*\w[^,;]*, [^,;]*\w[^,;]*", creator):
            raise Refusal(f"--creator '{creator}' is no name: give one person as 'Family, Given', and the option once for each")
    if not re.fullmatch(r"[A-Za-z0-9.+-]+", wanted.licence):
        raise Refusal(f"--licence '{wanted.licence}' is no name of a licence in the list of SPDX, such as CC-BY-4.0 or CC0-1.0")
    if not wanted.output.endswith(".zip"):
        raise Refusal(f"{wanted.output} does not end with .zip")
    if os.path.lexists(wanted.output):
        raise Refusal(f"{wanted.output} is there already: remove it, or name another file with --output")


class Substrate:
    """A folder that is whole, with what the pack says of it."""

    def __init__(self, name, allow_uncertified):
        self.manifest_file = manifest_path(name)
        self.manifest = read_manifest(self.manifest_file)
        self.folder = os.path.dirname(os.path.abspath(self.manifest_file))
        self.name = os.path.basename(self.folder)
        if not is_as_written(self.manifest_file):
            raise Refusal(f"{self.manifest_file} is not as it was written: make the substrate again")
        changed = changed_files(self.folder, self.manifest)
        if changed:
            raise Refusal(f"{len(changed)} files of {self.folder} are gone or not as they were written, such as {changed[0]}: copy it again, or make it again")
        if not self.manifest["certified"] and not allow_uncertified:
            raise Refusal(f"{self.folder} is not certified ({self.manifest['faults'][0]}): mend it, or take it all the same with --allow-uncertified")

    def files(self):
        """Of what was written, and nothing else that has come into the folder since."""
        return ["manifest.json", *self.manifest["sha256"]]

    def words(self):
        lower, upper = self.manifest["domain"][0::2], self.manifest["domain"][1::2]
        sides = [b - a for a, b in zip(lower, upper)]
        volume = sides[0] * sides[1] * sides[2]
        fibres = self.manifest["outer_surfaces"] or self.manifest["inner_surfaces"]
        parts = [f"{' x '.join(f'{side:.6g}' for side in sides)} µm, {fibres} fibres, {self.manifest['triangles']} triangles"]
        for label, kind in (("fibre volume fraction", "outer"), ("axon volume fraction", "inner")):
            if self.manifest[f"{kind}_surfaces"]:
                parts.append(f"{label} {self.manifest[f'{kind}_volume_um3'] / volume:.4f}")
        if "sample_of_fibres" in self.manifest:
            parts.append(f"surfaces of a sample of its {self.manifest['sample_of_fibres']} fibres")
        parts += ["certified" if self.manifest["certified"] else "not certified", f"for {self.manifest['simulator']}", f"CACTUS {self.manifest['version']}"]
        return ", ".join(parts)


def licence_link(name):
    return f"https://spdx.org/licenses/{name}.html"


def metadata(substrates, wanted):
    """As Zenodo takes it: the content of .zenodo.json, or the member `metadata` of its API."""
    names = [substrate.name for substrate in substrates]
    shown = ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")
    items = "".join(f"<li>{html.escape(one.name)}: {html.escape(one.words())}</li>" for one in substrates)
    return {
        "title": wanted.title or f"Synthetic white-matter substrates made with CACTUS: {shown}",
        "upload_type": "dataset",
        "description": "<p>Closed triangle meshes of fibres (micrometres), made with CACTUS for ParaView for Monte Carlo simulations of diffusion MRI. Each substrate has a "
                       "manifest, from which it can be made again, and a certificate of what was checked on its surfaces.</p>"
                       f"<ul>{items}</ul><p>The method: {html.escape(citation()['words'])}</p>",
        "creators": [{"name": name} for name in wanted.creator],
        "keywords": KEYWORDS,
        "version": wanted.version,
        "access_right": "open",
        "license": wanted.licence,
        "related_identifiers": [{"identifier": citation()["doi"], "relation": "cites", "scheme": "doi", "resource_type": "publication-article"}],
    }


def readme(substrates, data):
    lines = [data["title"], "=" * len(data["title"]), "", f"Version {data['version']}, by {'; '.join(one['name'] for one in data['creators'])}.",
             f"Licence of the data: {data['license']}, see LICENSE.txt.", ""]
    lines += [f"substrates/{one.name}/\n    {one.words()}" for one in substrates]
    lines += ["", "Each has a README.txt, a manifest.json (how it was made), a certificate.csv, and a page about it in reports/.",
              "previews/ has small files that ParaView opens, where a substrate has a file for each surface.", "",
              "Check all files:            sha256sum -c SHA256SUMS",
              "Make a substrate again:     ./cactus rerun substrates/NAME/manifest.json   (with CACTUS for ParaView)", "",
              "Cite this data set by its DOI, and the method:", f"    {citation()['words']}", f"    {citation()['link']}", ""]
    return "\n".join(lines)


def write_pages(substrate, place):
    """A report and, where the folder has a file for each surface, a preview, into folders of `place`."""
    from paraview import simple  # which nothing else here needs

    import preview
    import report

    if not hasattr(simple, "SubstrateStatistics"):
        raise Refusal("the plugin is not loaded: run this by ./cactus pack")
    os.makedirs(os.path.join(place, "reports"), exist_ok=True)
    report.write(os.path.join(place, "reports", substrate.name + ".html"), report.page(report.gathered(substrate.folder, substrate.manifest_file, True)))
    if substrate.manifest["simulator"] not in preview.IN_ONE_FILE:
        os.makedirs(os.path.join(place, "previews"), exist_ok=True)
        preview.write_preview(substrate.folder, substrate.manifest, os.path.join(place, "previews", substrate.name + ".vtm"), PREVIEW_TRIANGLES)
    for source in simple.GetSources().values():
        simple.Delete(source)  # what a substrate takes goes before the next one


def files_below(place):
    return {os.path.relpath(os.path.join(folder, name), place): os.path.join(folder, name) for folder, _, names in os.walk(place) for name in names}


def write_archive(path, files, folders):
    """Writes a zip archive of {name in it: file} and of folders, by name, below one folder of the archive's own name. Whole or not at all."""
    top = os.path.basename(path)[: -len(".zip")]
    beside = f"{path}.{os.getpid()}.part"
    try:
        with zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
            for name in sorted([*files, *(folder + "/" for folder in folders)]):
                info = zipfile.ZipInfo(f"{top}/{name}", TIME)
                info.create_system = 3  # Unix, whose permissions these are
                info.external_attr = (FOLDER_MODE << 16 | 0x10) if name.endswith("/") else FILE_MODE << 16
                if name.endswith("/"):
                    archive.writestr(info, b"")
                    continue
                info.compress_type = zipfile.ZIP_DEFLATED
                info.file_size = os.path.getsize(files[name])
                with open(files[name], "rb") as source, archive.open(info, "w") as target:
                    shutil.copyfileobj(source, target, 1 << 20)
        os.replace(beside, path)
    except OSError as error:
        raise Refusal(f"cannot write {path}: {error.strerror}") from error
    finally:
        if os.path.exists(beside):
            os.remove(beside)


def pack(wanted):
    checked(wanted)
    output = os.path.abspath(wanted.output)
    substrates = sorted((Substrate(name, wanted.allow_uncertified) for name in wanted.folders), key=lambda one: one.name)
    names = [one.name for one in substrates]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise Refusal(f"several folders are called {twice[0]}: rename one of them")
    for one in substrates:
        if os.path.commonpath([os.path.realpath(output), os.path.realpath(one.folder)]) == os.path.realpath(one.folder):
            raise Refusal(f"{output} is in {one.folder} itself: name a file outside with --output")
    with tempfile.TemporaryDirectory(prefix="cactus-pack-") as place:
        for one in substrates:
            print(f"    {one.name}: {one.words()}", flush=True)
            write_pages(one, place)
        data = metadata(substrates, wanted)
        texts = {
            ".zenodo.json": json.dumps(data, indent=2, ensure_ascii=False) + "\n",
            "README.txt": readme(substrates, data),
            "LICENSE.txt": f"The data in this archive are licensed under {wanted.licence}.\nIts text: {licence_link(wanted.licence)}\n",
        }
        for name, text in texts.items():
            with open(os.path.join(place, name), "w", encoding="utf-8") as file:
                file.write(text)
        files = files_below(place)
        for one in substrates:
            files.update({f"substrates/{one.name}/{path}": os.path.join(one.folder, path) for path in one.files()})
        sums = os.path.join(place, "SHA256SUMS")
        with open(sums, "w", encoding="utf-8") as file:
            file.writelines(f"{sha256(files[name])}  {name}\n" for name in sorted(files))
        folders = [f"substrates/{one.name}/{folder}" for one in substrates for folder in one.manifest["folders"]]
        write_archive(output, {**files, "SHA256SUMS": sums}, folders)
    print(f"Wrote {output}: {len(files) + 1} files, {os.path.getsize(output) / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(ended("pack", lambda: pack(arguments())))
