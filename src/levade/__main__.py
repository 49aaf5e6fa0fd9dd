"""Run the command line: ``python -m levade``."""

from levade.cli import main

if __name__ == "__main__":
    main()
