"""The command that measures where on the face the landmarks lie."""
