"""Types of the API's messages, for editors and type checkers: building the package writes them."""
