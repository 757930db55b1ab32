// Reads and operates the list of layers beside the timeline, as the artist would.
#pragma once

#include "host/parts.h"

namespace lampblack
{

/// Rows are numbered from the top, from 0. Pencil2D's own layer index counts from the bottom.
class LayerRows
{
public:
    explicit LayerRows(const Parts& parts) : mParts(parts) {}

    /// All layers, top first. Opens the properties dialog of each layer without showing it, and restores the
    /// current row. Takes about 3 ms a layer. Empty if the list is not the known one.
    QVector<Layer> read() const;

    /// Whether each of `count` layers is visible (has an open eye).
    QVector<bool> eyes(int count) const;
    void clickEye(int row) const;

    int currentRow() const; ///< -1 if it is not known
    void select(int row) const;

    /// Delete the layer of this row. False if it is not called `name` or the program does not delete it.
    /// Cannot be undone.
    bool remove(int row, const QString& name) const;
    bool rename(int row, const QString& name) const;

private:
    QImage renderRow(int row) const;
    void clickAt(int row, int x) const;
    void openProperties(int row) const;
    QString nameAt(int row, bool* isCamera) const;
    Layer::Kind recogniseKind(const QImage& rowImage) const;

    Parts mParts;
};

/// While it exists, the window is not repainted. Of a part of a window that alone is not repainted, nothing
/// is left when what it lies on is.
class UpdatesOff
{
public:
    explicit UpdatesOff(QWidget* window);
    ~UpdatesOff();
    Q_DISABLE_COPY_MOVE(UpdatesOff)

private:
    QPointer<QWidget> mWindow;
};

} // namespace lampblack
