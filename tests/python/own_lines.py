"""Number of lines of the user's own code in an example: `own_lines.py EXAMPLE...` prints them.

Lines with code count, including imports. Code that only compares and draws does not: the functions `soft` (the engine's
own contact) and `drawn` (for an animation), the block `if __name__`, and statements that use `judge` or a balance.
"""

import ast
import io
import sys
import tokenize
from pathlib import Path


def judges(statement):
    names = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
    names |= {node.attr for node in ast.walk(statement) if isinstance(node, ast.Attribute)}
    names |= {alias.name for node in ast.walk(statement) if isinstance(node, ast.Import) for alias in node.names}
    return bool(names & {"judge", "balance", "balances", "__name__"})


def left_out(statement):
    if isinstance(statement, ast.FunctionDef | ast.ClassDef):
        return statement.name in ("soft", "drawn")
    compound = isinstance(statement, ast.For | ast.While | ast.With | ast.If)
    return judges(statement) and (not compound or judges(getattr(statement, "test", ast.Pass())))


def docstring(node):
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def own_lines(text):
    code = {
        line
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if token.type
        not in (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER)
        for line in range(token.start[0], token.end[0] + 1)
    }
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.stmt) and (left_out(node) or docstring(node)):
            code -= set(range(node.lineno, node.end_lineno + 1))
    return sorted(code)


if __name__ == "__main__":
    for path in sys.argv[1:]:
        print(len(own_lines(Path(path).read_text(encoding="utf-8"))), Path(path).name)
