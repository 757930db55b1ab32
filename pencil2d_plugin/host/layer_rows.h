// The list of layers beside the time line, read and clicked as the artist would.
#pragma once

#include "host/parts.h"

namespace lampblack
{

/// Rows count from the top, 0. Pencil2D's own layer index counts from the bottom.
class LayerRows
{
public:
    explicit LayerRows(const Parts& parts) : mParts(parts) {}

    /// All layers, top first. Opens each layer's properties, unseen, and comes back to the row that was
    /// current: some 3 ms a layer. Empty if the list does not answer as it should.
    QVector<Layer> read() const;

    /// Which of `count` layers have an open eye.
    QVector<bool> eyes(int count) const;
    void clickEye(int row) const;

    int currentRow() const; ///< -1 if none can be made out
    void select(int row) const;

    /// Delete the layer of this row. False, with nothing done, if it is not called `name` or the program
    /// does not do it. A layer that is gone cannot be had back.
    bool remove(int row, const QString& name) const;
    bool rename(int row, const QString& name) const;

private:
    QImage picture(int row) const;
    void press(int row, int x) const;
    void openProperties(int row) const;
    QString nameAt(int row, bool* isCamera) const;
    Layer::Kind kindOf(const QImage& picture) const;

    Parts mParts;
};

/// Nobody sees what happens to these widgets while it lives.
class UpdatesOff
{
public:
    explicit UpdatesOff(const QVector<QWidget*>& widgets);
    ~UpdatesOff();
    Q_DISABLE_COPY_MOVE(UpdatesOff)

private:
    QVector<QPointer<QWidget>> mWidgets;
};

} // namespace lampblack
