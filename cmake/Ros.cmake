# Messages and the catkin side of the package.
find_package(catkin REQUIRED)
