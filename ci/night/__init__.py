"""Parts of the nightly run (ci/nightly): stages, history, change detection, trends, summary."""
