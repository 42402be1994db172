#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the documentation as a web site with search: pages by MkDocs, headers by Doxygen.

    tools/docs/site.py [FOLDER]         (default: build/docs/site; open FOLDER/index.html)
    tools/docs/site.py --pages FOLDER   only the Markdown pages, as they are installed

All Markdown pages of the repository are part of it, at their places, so that relative links hold.
Files that a page links to are copied. A link that leads nowhere is an error. Needs the Debian
packages mkdocs-material and, for the reference of headers, doxygen. The site loads nothing from
other places. Exit code 77: MkDocs is missing.
"""
import json
import os
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")
SKIPPED = ("share/templates/", "web/node_modules/", ".github/")
CODE = re.compile(r"^(```|~~~).*?^\1[^\n]*$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
# Headings of the menu, and which pages are below each.
MENU = [("Start", ["README.md", "docs/README.md", "docs/concepts.md", "docs/glossary.md"]),
        ("Tutorials", ["docs/tutorials/"]), ("Examples", ["examples/"]),
        ("How-to", ["docs/how-to/", "docs/troubleshooting.md"]),
        ("Reference", ["docs/reference/", "docs/frames-and-units.md", "docs/benchmarks.md"]),
        ("Explanation", ["docs/explanation/", "docs/decisions.md"]),
        ("Drivers", ["drivers/"]), ("Programs", ["programs/"]), ("Scenarios", ["scenarios/"]),
        ("Project", ["CONTRIBUTING.md", "docs/reading-the-code.md", "CHANGELOG.md", "SECURITY.md",
                     "CODE_OF_CONDUCT.md"])]


def tracked():
    listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "-co", "--exclude-standard"],
                            cwd=ROOT, capture_output=True, text=True, check=False).stdout.split("\n")
    found = [name for name in listed if name] or [
        p.relative_to(ROOT).as_posix() for folder in ("docs", "drivers", "programs", "scenarios", "examples")
        for p in (ROOT / folder).rglob("*") if p.is_file()]
    return {name for name in found if (ROOT / name).is_file() and not name.startswith(SKIPPED)}


def code_spans(text):
    return [match.span() for match in CODE.finditer(text)]


def stage_page(name, files, stage):
    """Copies a page and what it links to; a link to a folder becomes one to its README, or text."""
    text = (ROOT / name).read_text(encoding="utf-8")
    spans = code_spans(text)

    def resolve(match):
        target = match.group(2)
        in_code = any(begin <= match.start() < end for begin, end in spans)
        if in_code or re.match(r"^[a-z]+:", target):
            return match.group(0)
        path = posixpath.normpath(posixpath.join(posixpath.dirname(name), target))
        if path in files:
            if not path.endswith(".md"):
                copy(path, stage)
            return match.group(0)
        readme = posixpath.join(path, "README.md")
        if readme in files:
            return f"{match.group(1)}{target.rstrip('/')}/README.md{match.group(4)}"
        # A folder without a page: the site has no listing of it.
        return "](" + "#" + ")" if (ROOT / path).is_dir() else match.group(0)

    text = LINK.sub(resolve, text)
    text = re.sub(r"\[([^\]\n]*)\]\(#\)", r"\1", text)
    into = stage / name
    into.parent.mkdir(parents=True, exist_ok=True)
    into.write_text(text, encoding="utf-8")


def copy(name, stage):
    into = stage / name
    into.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / name, into)


def menu(pages, has_api):
    left = set(pages)
    for title, places in MENU:
        below = []
        for place in places:
            found = sorted(page for page in left if page == place or place.endswith("/") and page.startswith(place))
            below += sorted(found, key=lambda page: (page.count("/"), page))
            left -= set(found)
        if title == "Reference" and has_api:
            below.append({"C++ headers": "api/index.html"})
        yield {title: below}
    if left:
        yield {"More": sorted(left)}


def configuration(pages, has_api, stage, site):
    return {"site_name": "RAVE", "docs_dir": str(stage), "site_dir": str(site),
            "use_directory_urls": False, "strict": True,
            "theme": {"name": "material", "font": False,
                      "palette": [{"media": "(prefers-color-scheme: light)", "scheme": "default"},
                                  {"media": "(prefers-color-scheme: dark)", "scheme": "slate"}]},
            "plugins": ["search"],
            "markdown_extensions": ["tables", "fenced_code", "md_in_html", {"toc": {"permalink": True}}],
            "nav": list(menu(pages, has_api))}


def build_api(site):
    """The reference of headers below api/; nothing if Doxygen is missing."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([ROOT / "tools/docs/api.sh", folder], check=False)
        if done.returncode == 0:
            shutil.copytree(pathlib.Path(folder, "html"), site / "api")
        elif done.returncode != 77:
            sys.exit(done.returncode)


def stage_all(files, pages, stage):
    for name in pages:
        stage_page(name, files, stage)
    for name in files:
        if name.startswith("docs/images/"):
            copy(name, stage)


def write_pages(folder):
    """The pages with what they link to, so that no link leads out of the folder."""
    files = tracked()
    pages = sorted(name for name in files if name.endswith(".md"))
    shutil.rmtree(folder, ignore_errors=True)
    stage_all(files, pages, folder)
    print(f"{len(pages)} pages: {folder}")
    return 0


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--pages":
        return write_pages(pathlib.Path(sys.argv[2]).resolve())
    site = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/docs/site").resolve()
    if not shutil.which("mkdocs"):
        print("mkdocs is missing: apt-get install mkdocs-material")
        return 77
    files = tracked()
    pages = sorted(name for name in files if name.endswith(".md"))
    with tempfile.TemporaryDirectory() as folder:
        stage = pathlib.Path(folder, "pages")
        stage_all(files, pages, stage)
        has_api = shutil.which("doxygen") is not None
        if has_api:
            # A place for the menu; Doxygen's page takes it afterwards.
            (stage / "api").mkdir()
            (stage / "api/index.html").write_text("", encoding="utf-8")
        # JSON is YAML.
        file = pathlib.Path(folder, "mkdocs.yml")
        file.write_text(json.dumps(configuration(pages, has_api, stage, site)), encoding="utf-8")
        done = subprocess.run(["mkdocs", "build", "--quiet", "--clean", "--config-file", file], check=False,
                              env=dict(os.environ, NO_MKDOCS_2_WARNING="1"))
        if done.returncode != 0:
            return done.returncode
    if has_api:
        shutil.rmtree(site / "api")
        build_api(site)
    print(f"{len(pages)} pages: {site / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
