"""Parameters of a scene that explain a measurement."""
