"""Types of the API's messages, for editors and type checkers. Building the package generates them."""
