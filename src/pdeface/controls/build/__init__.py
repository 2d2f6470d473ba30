"""Measure expressions and identity modes on the head that the template was measured on."""
