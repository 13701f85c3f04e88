# For Doxygen: the comment at a header's top is the file's, and C's plain comments document what they stand at.
1 { s|^// |/// @file\n/// |; s|^/\* |/** @file\n * |; }
2,/^[^\/ ]/ { s|^//$|///|; s|^// |/// | }
1 ! s|^\( *\)/\* |\1/** |
s|\([;,]  *\)/\* |\1/**< |
