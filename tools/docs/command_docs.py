#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes everything that repeats the command line: the reference page, man pages, bash completion.

    tools/docs/command_docs.py --rave PROGRAM --page [--check]
    tools/docs/command_docs.py --rave PROGRAM --man FOLDER --bash FILE

The source is `rave --command-tree`, the same texts as `rave ... --help`. --page writes
docs/reference/commands.md; with --check nothing is written, and the exit code says whether the page
is up to date. --man writes rave.1 and one page per subcommand, --bash the completion of bash.
"""
import argparse
import difflib
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/reference/commands.md"
INTRODUCTION = """\
# Commands

Made by `tools/docs/command_docs.py` from the program; edit the texts in `cli/*_arguments.cpp` instead.
`rave COMMAND --help` prints the same, and so does `man rave-COMMAND` of an installed RAVE. Values in
square brackets are defaults. All commands exit with 0 if all is well, 1 if a run or a check failed, and
2 for bad input.
"""
# Such as `box, disc or polygon` and `Speed: max, realtime, or a factor`.
CHOICES = re.compile(r"^(?:[A-Z][a-z]+: )?([a-z0-9_]+(?:, [a-z0-9_]+)*),? or (a )?([a-z0-9_]+)(?:$|[ \[;(])")
FILE_VALUES = {"FILE", "SCENARIO", "OUT.svg|OUT.png", "WHAT", "BUILD_A", "BUILD_B"}
FOLDER_VALUES = {"DIR"}
HELP = {"names": ["-h", "--help"], "positional": False, "value": "", "required": False,
        "repeatable": False, "text": "Print this help message and exit"}


def tree_of(rave):
    done = subprocess.run([rave, "--command-tree"], capture_output=True, text=True, timeout=60,
                          check=True)
    return json.loads(done.stdout)


def leaves(command, above=()):
    """(words, command) of every command that does something, in order."""
    for below in command["commands"]:
        words = above + (below["name"],)
        if below["commands"]:
            yield from leaves(below, words)
        else:
            yield words, below


def groups(command, above=()):
    """(words, command) of every command with subcommands, the first being the root."""
    yield above, command
    for below in command["commands"]:
        if below["commands"]:
            yield from groups(below, above + (below["name"],))


def positionals(command):
    return [o for o in command["options"] if o["positional"]]


def flags(command):
    return [o for o in command["options"] if not o["positional"]]


def value_of(option):
    """Such as `N` and `1 to 1024` of `N:INT in [1 - 1024]`."""
    name, _, limits = option["value"].partition(":")
    found = re.search(r"\[(\S+) - (\S+)\]", limits)
    return name, f"{found.group(1)} to {found.group(2)}" if found else ""


def usage(words, command):
    parts = ["rave", *words]
    if flags(command):
        parts.append("[OPTIONS]")
    for option in positionals(command):
        name = value_of(option)[0]
        # A name of several words says itself what follows what.
        name += "..." if option["repeatable"] and " " not in name else ""
        parts.append(name if option["required"] else f"[{name}]")
    return " ".join(parts + (["COMMAND"] if command["commands"] else []))


def title_of(option):
    name = value_of(option)[0]
    if option["positional"]:
        return name
    return ", ".join(option["names"]) + (f" {name}" if name else "")


def text_of(option):
    notes = [value_of(option)[1], "required" if option["required"] and not option["positional"] else ""]
    notes = [note for note in notes if note]
    return option["text"] + (f" ({'; '.join(notes)})" if notes else "")


# --- the page ------------------------------------------------------------------------------------

def cell(text):
    return text.replace("|", r"\|").replace("<", r"\<")


def examples_apart(footer):
    """The prose of a footer and its examples."""
    prose, _, examples = re.sub(r"^Examples?:\n", "\nExample:\n", footer).partition("\nExample")
    lines = [line.strip() for line in examples.splitlines()[1:]] if examples else []
    joined = re.sub(r"\\\n", "\\\n    ", "\n".join(lines).split("\n\n")[0])
    return re.sub(r"\s*\n\s*", " ", prose).strip(), joined.strip()


def section(words, command):
    yield f"\n## rave {' '.join(words)}\n\n{command['text']}.\n\n    {usage(words, command)}\n"
    listed = positionals(command) + [o for o in flags(command) if "--help" not in o["names"]]
    if listed:
        yield "\n| argument | meaning |\n|---|---|\n"
        for option in listed:
            yield f"| `{cell(title_of(option))}` | {cell(text_of(option))} |\n"
    prose, examples = examples_apart(command["footer"])
    if prose:
        yield "\n" + re.sub(r"<([^>]*)>", r"`<\1>`", prose) + "\n"
    if examples:
        yield "\nExamples:\n\n" + "".join(f"    {line}\n" for line in examples.splitlines())


def page_of(tree):
    text = INTRODUCTION + "\n| command | what it does |\n|---|---|\n"
    every = list(leaves(tree))
    # The options of the network are the same in many commands; a table each would hide the others.
    for words, command in every:
        name = " ".join(words)
        anchor = "rave-" + "-".join(words)
        text += f"| [`rave {name}`](#{anchor}) | {cell(command['text'])} |\n"
    parents = {words: command for words, command in groups(tree) if words}
    for words, command in every:
        parent = parents.get(words[:-1])
        if parent:
            command = dict(command, options=positionals(parent) + command["options"],
                           footer=command["footer"] or parent["footer"])
        text += "".join(section(words, command))
    return text


# --- man pages -----------------------------------------------------------------------------------

def roff(text):
    escaped = text.replace("\\", r"\e").replace("-", r"\-").replace("`", "")
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in escaped.split("\n"))


def man_page(words, command, below):
    name = "-".join(("rave", *words))
    out = [f'.TH "{name.upper()}" "1" "" "RAVE" "User Commands"', ".SH NAME",
           f"{roff(name)} \\- {roff(command['text'][0].lower() + command['text'][1:])}", ".SH SYNOPSIS",
           f".B {roff(usage(words, command))}"]
    if below:
        out.append(".SH COMMANDS")
        for path, each in below:
            out += [".TP", f".B {roff(' '.join(path))}", roff(each["text"] + ".")]
    listed = positionals(command) + flags(command)
    if listed:
        out.append(".SH OPTIONS")
        for option in listed:
            out += [".TP", f".B {roff(title_of(option))}", roff(text_of(option) + ".")]
    prose, examples = examples_apart(command["footer"])
    if prose:
        out += [".SH NOTES", roff(prose)]
    if examples:
        out += [".SH EXAMPLES", ".nf", roff(examples), ".fi"]
    others = ["rave-" + "-".join(path[:1]) for path, _ in below] if not words else ["rave"]
    others = sorted(set(others))
    out += [".SH SEE ALSO", ",\n".join(f".BR {roff(other)} (1)" for other in others).replace(",\n", " ,\n")]
    return name, "\n".join(out) + "\n"


def man_pages(tree):
    """(file name, text) of all pages: a command with subcommands has one page, and so has each."""
    for words, command in groups(tree):
        below = [(path, each) for path, each in leaves(command, words)] if words else \
                [((each["name"],), each) for each in command["commands"]]
        yield man_page(words, command, below)
    for words, command in leaves(tree):
        yield man_page(words, command, [])


# --- completion ----------------------------------------------------------------------------------

def completion_of(option):
    """What bash offers for a value: words, files, folders, or the output of a function."""
    name = value_of(option)[0]
    if name == "SCENARIO" or name == "WHAT":
        return "scenarios"
    if name in ("DRIVER", "RUN"):
        return {"DRIVER": "drivers", "RUN": "runs"}[name]
    if name in FOLDER_VALUES:
        return "folders"
    if name in FILE_VALUES or name.startswith("FILE"):
        return "files"
    if re.fullmatch(r"[A-Za-z]+(\|[A-Za-z]+)+", name):
        return "words " + name.replace("|", " ")
    found = CHOICES.match(option["text"])
    if found and name not in ("N", "S"):
        last = [] if found.group(2) else [found.group(3)]
        return "words " + " ".join([*found.group(1).split(", "), *last])
    return "nothing"


BASH = r"""# Completion of bash for rave. Made by tools/docs/command_docs.py from `rave --command-tree`.
# In zsh: autoload -U +X bashcompinit && bashcompinit, then source this file.

_rave_offer() {
  local share
  case "$1" in
    words) COMPREPLY=($(compgen -W "${*:2}" -- "$cur")) ;;
    files) COMPREPLY=($(compgen -f -- "$cur")) ;;
    folders) COMPREPLY=($(compgen -d -- "$cur")) ;;
    scenarios)
      share="$(dirname "$(type -P "${COMP_WORDS[0]}" || echo /)")/../share/rave/scenarios"
      COMPREPLY=($(compgen -f -- "$cur") $(compgen -W "$(ls -d scenarios/*/ "$share"/*/ 2>/dev/null |
        sed 's|/$||; s|.*/||' | sort -u)" -- "$cur")) ;;
    drivers)
      COMPREPLY=($(compgen -W "$("${COMP_WORDS[0]}" drivers --json 2>/dev/null |
        sed -n 's/^      "name": "\([a-z0-9_]*\)".*/\1/p' | sort -u)" -- "$cur")) ;;
    runs)
      COMPREPLY=($(compgen -W "$("${COMP_WORDS[0]}" ps 2>/dev/null |
        awk 'NR > 2 && $1 == "│" && $2 != "│" { print $2 }' | sort -u)" -- "$cur")) ;;
  esac
}

_rave() {
  local cur="${COMP_WORDS[COMP_CWORD]}" command="" position=0 i word value
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word="${COMP_WORDS[i]}"
    if [[ " ${_rave_commands[$command]} " == *" $word "* ]]; then
      command="${command:+$command }$word"
      position=0
    elif [[ "$word" == -* ]]; then
      [[ -n "${_rave_values[$command $word]}" ]] && ((++i))
    else
      ((++position))
    fi
  done
  if [[ "$i" -gt "$COMP_CWORD" ]]; then
    _rave_offer ${_rave_values[$command ${COMP_WORDS[COMP_CWORD - 1]}]}
  elif [[ "$cur" == -* ]]; then
    _rave_offer words ${_rave_options[$command]}
  elif [[ -n "${_rave_commands[$command]}" ]]; then
    _rave_offer words ${_rave_commands[$command]}
  else
    value="${_rave_values[$command $position]:-${_rave_values[$command last]}}"
    _rave_offer ${value:-nothing}
  fi
}
"""


def bash_table(name, entries):
    lines = "".join(f'  ["{key}"]="{value}"\n' for key, value in entries if value)
    return f"declare -gA {name}=(\n{lines})\n"


def all_commands(tree):
    yield from groups(tree)
    yield from leaves(tree)


def bash_completion(tree):
    commands, options, values = [], [], []
    for words, command in all_commands(tree):
        # Bash has no empty key, so the root's is a blank.
        key = " ".join(words)
        commands.append((key or "root", " ".join(c["name"] for c in command["commands"])))
        options.append((key or "root", " ".join(n for o in flags(command) for n in o["names"] if
                                                n.startswith("--"))))
        for option in flags(command):
            if option["value"]:
                values += [(f"{key or 'root'} {name}", completion_of(option)) for name in option["names"]]
        if not command["commands"]:
            listed = positionals(command)
            values += [(f"{key or 'root'} {i}", completion_of(o)) for i, o in enumerate(listed)]
            if listed and listed[-1]["repeatable"]:
                values.append((f"{key} last", completion_of(listed[-1])))
    body = BASH.replace('command="" position', 'command=root position').replace(
        'command="${command:+$command }$word"',
        '[[ "$command" == root ]] && command="$word" || command="$command $word"')
    return (body + bash_table("_rave_commands", commands) + bash_table("_rave_options", options) +
            bash_table("_rave_values", values) + "complete -F _rave rave\n")


# -------------------------------------------------------------------------------------------------

def check_page(text):
    there = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    difference = list(difflib.unified_diff(there.splitlines(), text.splitlines(),
                                           str(PAGE.relative_to(ROOT)), "the program", lineterm=""))
    print(*difference[:40], sep="\n")
    print("docs/reference/commands.md is", "out of date" if difference else "up to date")
    return 1 if difference else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rave", required=True)
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--man", type=pathlib.Path)
    parser.add_argument("--bash", type=pathlib.Path)
    arguments = parser.parse_args()
    tree = tree_of(arguments.rave)
    if arguments.man:
        arguments.man.mkdir(parents=True, exist_ok=True)
        for name, text in man_pages(tree):
            (arguments.man / f"{name}.1").write_text(text, encoding="utf-8")
    if arguments.bash:
        arguments.bash.parent.mkdir(parents=True, exist_ok=True)
        arguments.bash.write_text(bash_completion(tree), encoding="utf-8")
    if arguments.page and arguments.check:
        return check_page(page_of(tree))
    if arguments.page:
        PAGE.write_text(page_of(tree), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
