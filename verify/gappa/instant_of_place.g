#@ -Eprecision=128
# middleware/depth/body_places.cpp, instantOf(): whole microseconds below 2^53 and a fraction,
# their sum, a quotient: <= 1.
kInstantOfPlace = 4 * 0x1p-53;
{ |s| <= 1b-53 /\ |q| <= 1b-53 -> |(1 + s) * (1 + q) - 1| / kInstantOfPlace <= 1 }
