"""The run engine: compare/engine/engine.hpp, and its client for scripts."""
