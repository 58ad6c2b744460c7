"""Notebooks as the scripts of examples/ hold them: their cells, and what the cells of code show."""

import ast


def cells(path, kind):
    """Cells of a kind, markdown or code."""
    import jupytext  # which no other test needs

    notebook = jupytext.reads(path.read_text(encoding="utf-8"), fmt="py:percent")
    return [cell.source for cell in notebook.cells if cell.cell_type == kind]


def ran(path):
    """Names after all cells ran in order; `answers`: what a notebook shows under each, the value of its last line."""
    names = {"__name__": "__main__"}
    answers = []
    for source in cells(path, "code"):
        tree = ast.parse(source)
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, str(path), "exec"), names)
        answers.append(eval(compile(ast.Expression(last.value), str(path), "eval"), names) if last else None)
    return names | {"answers": answers}
