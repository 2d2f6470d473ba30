"""How fast the studio's page answers, in a headless browser."""
