"""The command that measures what lies behind the openings."""
