#@ -Eprecision=128
# tessellation/swept_surface.cpp, Budget::corner(): as lattice.g.
kLatticeRounding = 0.8661;
{ half in [0, 0.5] -> sqrt(3 * half * half) / kLatticeRounding <= 1 }
