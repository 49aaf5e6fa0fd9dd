"""The engine ode. Nothing here is imported, and no library looked for, before an engine is made."""
