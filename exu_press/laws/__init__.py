"""Laws of contact, friction, film and load: pure functions, no Exudyn."""
