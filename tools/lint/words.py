#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Words that must not come back, and the length of the explanation pages.

The phrases stand in a table of docs/glossary.md: what is not written, what is written instead, and
where: `pages` are all Markdown files, `sources` are also the texts in C++ and TypeScript, `messages`
are only the texts of MESSAGE_FOLDERS, `comments` are the comments of the same folders, of IDL files
and of YAML files, and the descriptions in the schema of the page's messages. Code in pages does not
count, nor do the change log and the pages that are generated from sources.
"""
import re

import common

GLOSSARY = "docs/glossary.md"
HEADING = "## Words that this project does not use"
EXPLANATION = "docs/explanation/"
MOST_WORDS = 1500
# History, and what is generated from the texts in sources, which are checked themselves.
NOT_PAGES = ("CHANGELOG.md", "CODE_OF_CONDUCT.md", "docs/reference/drivers.md",
             "docs/reference/files.md", "docs/reference/commands.md", "data/")
CODE = re.compile(r"^(```|~~~).*?^\1[^\n]*$|`[^`\n]*`|(?<=\n\n)(?: {4}[^\n]*\n)+",
                  re.MULTILINE | re.DOTALL)
TEXT = re.compile(r'"(?:\\.|[^"\\\n])*"(?:\s*"(?:\\.|[^"\\\n])*")*')
SCRIPT_TEXT = re.compile(r"'(?:\\.|[^'\\\n])*'|\"(?:\\.|[^\"\\\n])*\"|`(?:\\.|[^`\\])*`")
COMMENT = re.compile(r"(?<![:\"'`\w])//[^\n]*(?:\n\s*//[^\n]*)*|/\*.*?\*/", re.DOTALL)
YAML_COMMENT = re.compile(r"(?<![^\s])#[^\n]*(?:\n\s*#[^\n]*)*")
DESCRIPTION = re.compile(r'(?<="description": )"(?:\\.|[^"\\\n])*"')
COMMENT_SIGN = re.compile(r"\n\s*(?://[/!]?|\*|#)")
# Made from schemas/gui by tools/gui_types.py.
GENERATED = ("web/protocol/messages.ts",)
MESSAGE_FOLDERS = ("cli/", "drivers/", "libs/", "ops/", "programs/", "runtime/", "servers/", "web/")
# The files of configuration that are shipped, and the schema that the page's types are made from.
YAML_FOLDERS = ("robots/", "scenarios/", "share/templates/", "worlds/")
MESSAGES_SCHEMA = "schemas/gui/messages.schema.json"
SCRIPT_FOLDERS = ("web/app/", "web/model/", "web/panels/", "web/panel_api/", "web/ui/")


def phrases(tree):
    """[(pattern, phrase, instead, where it holds)] of the table."""
    found = []
    text = tree.read(GLOSSARY) if GLOSSARY in tree.files else ""
    for line in text.partition(HEADING)[2].splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) != 3 or cells[0] == "not":
            continue
        if set(cells[0]) <= set("-: "):
            continue
        words = [re.escape(part).replace(r"\ ", r"\s+") for part in cells[0].split("…")]
        pattern = r"(?<!\w)" + r".{0,40}?".join(words) + r"(?!\w)"
        found.append((re.compile(pattern, re.IGNORECASE | re.DOTALL), cells[0], cells[1],
                      cells[2]))
    return found


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def page_of(tree, name):
    text = tree.read(name)
    if name == GLOSSARY:
        text = text.partition(HEADING)[0]
    return CODE.sub(blank, text)


def is_page(name):
    return name.endswith(".md") and not name.startswith(NOT_PAGES)


def texts_of(tree, name):
    """(offset, text) of what a person may read of a source."""
    text = tree.read(name)
    script = name.endswith(".ts")
    # A literal in a comment is none that is read while the program runs.
    text = re.sub(r"(?<![:\"'`\w])//[^\n]*", blank, text)
    for match in (SCRIPT_TEXT if script else TEXT).finditer(text):
        yield match.start(), re.sub(r'"\s*"', "", match.group(0))


def comments_of(tree, name):
    """(offset, text) of each comment; the lines of a block are one, and keep their length."""
    pattern = YAML_COMMENT if name.endswith(".yaml") else DESCRIPTION if name.endswith(".json") else COMMENT
    for match in pattern.finditer(tree.read(name)):
        yield match.start(), COMMENT_SIGN.sub(lambda sign: "\n" + " " * (len(sign.group(0)) - 1),
                                              match.group(0))


def commented_sources(tree):
    for name in tree.files:
        if name.endswith(".idl") or name == MESSAGES_SCHEMA or name.endswith(".yaml") and name.startswith(YAML_FOLDERS):
            yield name
        if not name.startswith(MESSAGE_FOLDERS) or name.startswith(("web/e2e/", *GENERATED)):
            continue
        if name in tree.sources or name.endswith(".ts"):
            if not common.is_support(name) and not name.endswith((".test.ts", "_test.cpp")):
                yield name


def readable_sources(tree):
    for name in tree.files:
        if common.is_support(name) or name.startswith("tests/"):
            continue
        if name in tree.sources and not name.endswith("_test.cpp"):
            yield name
        elif name.endswith(".ts") and name.startswith(SCRIPT_FOLDERS):
            if not name.endswith(".test.ts"):
                yield name


def check_words(tree):
    forbidden = phrases(tree)
    if GLOSSARY in tree.files and not forbidden:
        yield f"{GLOSSARY}: there is no table of phrases below `{HEADING}`"
    for name in filter(is_page, tree.files):
        text = page_of(tree, name)
        for pattern, phrase, instead, where in forbidden:
            if where in ("messages", "comments"):
                continue
            for match in pattern.finditer(text):
                line = text.count("\n", 0, match.start()) + 1
                yield f"{name}:{line}: not `{phrase}`, but {instead} ({GLOSSARY})"
    for name in readable_sources(tree):
        scopes = ("sources", "messages") if name.startswith(MESSAGE_FOLDERS) else ("sources",)
        in_sources = [entry for entry in forbidden if entry[3] in scopes]
        for offset, text in texts_of(tree, name):
            for pattern, phrase, instead, _ in in_sources:
                if pattern.search(text):
                    line = tree.read(name).count("\n", 0, offset) + 1
                    yield f"{name}:{line}: not `{phrase}`, but {instead} ({GLOSSARY})"


def check_comments(tree):
    forbidden = [entry for entry in phrases(tree) if entry[3] == "comments"]
    for name in commented_sources(tree) if forbidden else ():
        for offset, text in comments_of(tree, name):
            for pattern, phrase, instead, _ in forbidden:
                for match in pattern.finditer(text):
                    line = tree.read(name).count("\n", 0, offset + match.start()) + 1
                    yield f"{name}:{line}: a comment says `{phrase}`, not {instead} ({GLOSSARY})"


def check_lengths(tree):
    for name in tree.files:
        if not (name.startswith(EXPLANATION) and name.endswith(".md")):
            continue
        words = len(tree.read(name).split())
        if words > MOST_WORDS:
            yield (f"{name}: {words} words; an explanation has at most {MOST_WORDS}: move figures "
                   "to docs/benchmarks.md, formats to docs/reference, or split the page")


def check(tree):
    return [*check_words(tree), *check_comments(tree), *check_lengths(tree)]


TABLE = f"# G\n{HEADING}\n| not | but | where |\n|---|---|---|\n"
WORDS = TABLE + "| the old word | new | pages |\n| how … fare | state | sources |\n| nobody | none | messages |\n"
WORDS += "| goes on | continues | comments |\n"
CLEAN = {
    GLOSSARY: WORDS,
    "docs/a.md": "A new word, nobody's. `the old word`\n```\nthe old word\n```\n\n    the old word\n",
    "CHANGELOG.md": "the old word\n",
    "cli/a.cpp": '// how they fare\nauto a = "the old word";\n',
    "bench/a.cpp": 'auto a = "nobody";\n',
    "libs/sim/a.cpp": "int a;  // it goes, on\n",
    "libs/sim/tests/a.cpp": "// it goes on\n",
    "web/app/b.ts": "const a = 'goes on';\n",
    "robots/a.yaml": "title: a#goes on\n",
    MESSAGES_SCHEMA: '{"title": "goes on"}\n',
    "cli/tests/a_test.cpp": 'auto a = "how they fare";\n',
    "web/app/a.ts": "// how they fare\nconst a = 'welfare';\n",
    "docs/explanation/a.md": "word " * MOST_WORDS + "\n",
}
BREACHES = [
    ("docs/a.md:2: not `the old word`, but new",
     {GLOSSARY: WORDS, "docs/a.md": "A\n10. The old\n    word.\n"}),
    ("not `how … fare`", {GLOSSARY: WORDS, "docs/a.md": "See how hosts fare.\n"}),
    ("cli/a.cpp:1: not `how", {GLOSSARY: WORDS, "cli/a.cpp": 'auto a = "how hosts "\n  "fare";\n'}),
    ("web/app/a.ts:2: not `how", {GLOSSARY: WORDS, "web/app/a.ts": "\nconst a = 'How we fare';\n"}),
    ("cli/b.cpp:1: not `nobody`", {GLOSSARY: WORDS, "cli/b.cpp": 'auto a = "for nobody";\n'}),
    ("libs/sim/b.cpp:3: a comment says `goes on`",
     {GLOSSARY: WORDS, "libs/sim/b.cpp": "int a;\n// The run\n// goes\n/// on.\n"}),
    ("web/app/b.ts:2: a comment says `goes on`", {GLOSSARY: WORDS, "web/app/b.ts": "/** A run\n * goes on. */\n"}),
    ("robots/a.yaml:2: a comment says `goes on`", {GLOSSARY: WORDS, "robots/a.yaml": "a: 1  # A run\n# goes on.\n"}),
    ("schemas/idl/a.idl:1: a comment says `goes on`", {GLOSSARY: WORDS, "schemas/idl/a.idl": "/// It goes on.\n"}),
    (f"{MESSAGES_SCHEMA}:1: a comment says `goes on`",
     {GLOSSARY: WORDS, MESSAGES_SCHEMA: '{"description": "It goes on."}\n'}),
    ("there is no table", {GLOSSARY: "# G\n"}),
    ("1501 words", {"docs/explanation/a.md": "word " * (MOST_WORDS + 1)}),
]

if __name__ == "__main__":
    common.main(check, CLEAN, BREACHES)
