"""How made-up figures are built: the clay, the cloth, the faces and the bodies."""
