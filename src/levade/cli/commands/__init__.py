"""Commands and their options. What a command does is imported when it runs, so ``levade --help`` needs no physics."""
