"""Studies: thousands of impacts, one step each, by a unit that knows the mass."""
