"""Studies: thousands of impacts, one step each, with an FMU that knows the mass."""
