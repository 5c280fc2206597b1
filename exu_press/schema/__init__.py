"""Typed tables of TOML and JSON: one validation."""
