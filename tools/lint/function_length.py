#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether a function has grown beyond what one looks at as a whole: more than 60 lines.

    tools/lint/function_length.py [--self-test] [--root DIR]

Counted are the lines from the opening brace to the closing one (in Python from `def`), in C++,
TypeScript, JavaScript and Python, tests among them. A function within another one is a part of it.
"""
import ast
import re

import common

MOST_LINES = 60
SCRIPT_ENDS = (".ts", ".mjs", ".js")
PREPROCESSOR = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
# What may hold functions without being one.
SCOPE = re.compile(r'^(?:(?:template\s*<.*>|inline|export|default|abstract|declare|friend|typedef)\s*)*'
                   r'(?:namespace|class|struct|union|enum|interface|extern)\b', re.DOTALL)
# After the parameters of a C++ function; what comes in braces before is a member that it sets.
CPP_BODY = re.compile(r"(?:[)}]|\b(?:const|noexcept|override|final|mutable|try)|&&?|->[\s\w:<>,*&]+)$")
SCRIPT_BODY = re.compile(r"(?:=>|\)(?:\s*:[^;=]*[\w>\]}])?)$")
# With a condition before its braces, but no function.
STATEMENT = re.compile(r"^(?:\}?\s*else\s+)?(?:if|for|while|switch|catch|with)\b")
REGEX_BEFORE = re.compile(r"(?:^|[(,=:\[!&|?{};]|\breturn)\s*$")
SCRIPT_TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])*'|\"(?:\\.|[^\"\\\n])*\"", re.DOTALL)
SCRIPT_REGEX = re.compile(r"/(?![/*])(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\\\n\[])+/")


def script_code(text):
    """TypeScript without comments, literals and the text of templates; lines keep their number."""
    out, at = [], 0
    templates = []  # the depth of braces at which the expression of each template ends
    depth = 0

    def skip_template(at):
        while at < len(text) and text[at] != "`":
            if text.startswith("${", at):
                return at + 2, True
            if text[at] == "\n":
                out.append("\n")
            at += 2 if text[at] == "\\" else 1
        return at + 1, False

    while at < len(text):
        c = text[at]
        token = SCRIPT_TOKEN.match(text, at)
        if not token and c == "/" and REGEX_BEFORE.search("".join(out[-40:])):
            token = SCRIPT_REGEX.match(text, at)
        if token:
            out.append(" " + "\n" * token.group(0).count("\n"))
            at = token.end()
        elif c == "`" or (c == "}" and templates and templates[-1] == depth):
            if c == "}":
                templates.pop()
            at, inside = skip_template(at + 1)
            out.append(" 0 ")
            if inside:
                templates.append(depth)
        else:
            depth += (c == "{") - (c == "}")
            out.append(c)
            at += 1
    return "".join(out)


def is_body(head, script):
    if STATEMENT.match(head):
        return False
    return "(" in head and bool((SCRIPT_BODY if script else CPP_BODY).search(head)) or (
        script and head.endswith("=>"))


def functions(code, script):
    """First line, number of lines and head of each function that is not part of another one."""
    line, head, parens = 1, "", 0
    blocks = []  # what each open brace is: None, or the start of a function
    for c in code:
        line += c == "\n"
        parens += (c == "(") - (c == ")")
        inside = any(blocks)
        if c == "{":
            text = " ".join(head.split())
            start = (line, text) if not inside and is_body(text, script) else None
            keeps = not (inside or start or SCOPE.match(text) or STATEMENT.match(text))
            # Members that are set, default values and types belong to the head of a function.
            keeps = keeps and "(" in text and (not script or parens > 0 or text.endswith((":", "|")))
            blocks.append(start or "")
            head = head + c if keeps else ""
        elif c == "}":
            block = blocks.pop() if blocks else ""
            if block:
                yield block[0], line - block[0] + 1, block[1]
            head = head + c if not block and not any(blocks) and "{" in head else ""
        elif c == ";" and parens == 0:
            head = ""
        elif not inside:
            head += c


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.lineno, node.end_lineno - node.lineno + 1, f"def {node.name}"


def functions_of(name, text):
    if name.endswith(".py"):
        return python_functions(text)
    script = name.endswith(SCRIPT_ENDS)
    code = script_code(text) if script else PREPROCESSOR.sub(
        lambda line: "\n" * line.group(0).count("\n"), common.code_of(text))
    return functions(code, script)


def check(tree):
    for name in tree.files:
        if not name.endswith((*common.SOURCE_ENDS, *SCRIPT_ENDS, ".py")) or common.is_template(name):
            continue
        for line, count, head in functions_of(name, tree.read(name)):
            if count > MOST_LINES:
                yield (f"{name}:{line}: {count} lines; expected at most {MOST_LINES}: "
                       f"`{head[-60:].strip()}` does more than one thing")


def body(head, count, tail="}"):
    return "\n".join([head, *["  x();"] * (count - 2), tail]) + "\n"


CLEAN = {
    "libs/a/a.cpp": "namespace a {\n" + body("int f() {", 60) + body("int g() const noexcept {", 60) +
                    "}\n" + body("constexpr int kTable[] = {", 80, "};"),
    "libs/a/a.hpp": "class A final {\n" + body("A() : b_{1}, c_(2) {", 50) * 3 + "};\n" +
                    body("const char* kText = R\"(void f() {", 70, "})\";"),
    "web/a.ts": "export class A {\n" + body("  f(a: {x: number}): {y: number} {", 60) * 2 + "}\n" +
                body("const kTable = {", 90, "};") + "const page = html`\nfunction f() {" + "\n" * 70 + "}`;\n",
    "tools/a.py": "def f():\n" + "    pass\n" * 59 + "TABLE = [\n" + "    1,\n" * 70 + "]\n",
}
BREACHES = [
    ("libs/a/a.cpp:2: 61 lines", {"libs/a/a.cpp": "namespace a {\n" + body("int f() {", 61) + "}\n"}),
    ("A::A", {"libs/a/a.cpp": body("A::A(int b) noexcept : b_{b}, c_{1, 2} {", 61)}),
    ("auto f", {"libs/a/a.hpp": body("auto f(int a) -> std::pair<int, int> {", 61)}),
    ("libs/a/a.cpp:2", {"libs/a/a.cpp": "struct A {\n" + body("  friend bool f(A& a) {", 61) + "};\n"}),
    ("TEST(A, B)", {"libs/a/tests/a_test.cpp": body("TEST(A, B) {", 61)}),
    ("LLVM", {"libs/a/fuzz/a.cpp": body('extern "C" int LLVMFuzz(const char* data) {', 61)}),
    # What is within it counts for it.
    ("libs/a/a.cpp:1: 80 lines", {"libs/a/a.cpp": body("void f() { if (a) {\n}", 79)}),
    ("web/a.ts:2", {"web/a.ts": "class A {\n" + body("  f({a}: B): Map<string, number> {", 61) + "}\n"}),
    ("web/a.ts:1", {"web/a.ts": body("export const f = async (a: {b: number}) => {", 61, "};")}),
    ("web/e2e/a.mjs:1", {"web/e2e/a.mjs": body("async function f(a = /[{/]/, b = `${{c}}{`) {", 61)}),
    ("tools/a.py:1: 61 lines", {"tools/a.py": "def f():\n" + "    pass\n" * 60}),
]

if __name__ == "__main__":
    common.main(lambda tree: list(check(tree)), CLEAN, BREACHES)
