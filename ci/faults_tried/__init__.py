"""What ci/faults tries, and how."""
