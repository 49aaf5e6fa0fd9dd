"""The engine ode. Nothing is imported here, and no library loaded, before an engine is made."""
