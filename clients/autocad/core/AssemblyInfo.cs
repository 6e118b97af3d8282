using System.Reflection;
using System.Runtime.CompilerServices;

[assembly: AssemblyTitle("Wedm.Core")]
[assembly: AssemblyVersion("0.1.0.0")]
[assembly: InternalsVisibleTo("Wedm.Tests")]
