"""The border between holding and failing, axis by axis: compare/stability."""
