# For Doxygen: the comment at a header's top is the file's, C's plain comments document what they stand at, links lead to pages.
1 { /Copyright (c)/ { s/.*//; n; }; s|^// |/// @file\n/// |; s|^/\* |/** @file\n * |; }
2,/^[^\/ ]/ { s|^//$|///|; s|^// |/// | }
1 ! s|^\( *\)/\* |\1/** |
s|\([;,]  *\)/\* |\1/**< |
# In links between pages Doxygen finds the page, not the heading in it.
s|](\([a-z_]*\.md\)#[a-z0-9-]*)|](\1)|g
