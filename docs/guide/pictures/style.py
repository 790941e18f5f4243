"""How the pictures of README and guide look."""

STYLE = {
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.grid": True,
    "grid.alpha": 0.3,
    # lines of the grid say where the numbers are
    "xtick.bottom": False,
    "ytick.left": False,
}
