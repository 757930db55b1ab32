"""Makes line drawings with exact normals, depth and occlusions from meshes."""
