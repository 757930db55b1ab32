// A button that shows a colour and opens a dialog to change it.
#pragma once

#include <QColor>
#include <QColorDialog>
#include <QPointer>
#include <QToolButton>

namespace lampblack
{

/// While the dialog is open, edited() is emitted for each choice, as one gesture. Cancel restores the colour.
class ColourButton : public QToolButton
{
    Q_OBJECT

public:
    ColourButton(const QString& name, const QString& label, QWidget* parent = nullptr);

    QColor colour() const { return mColour; }
    /// Show a colour; does not emit edited().
    void setColour(const QColor& colour);
    /// Choose a colour in the dialog, if it is open.
    void choose(const QColor& colour);
    /// Close the dialog, if it is open. What was chosen stays.
    void closeDialog();

Q_SIGNALS:
    void edited(const QColor& colour, int gesture);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void openDialog();

    QColor mColour = Qt::white;
    QPointer<QColorDialog> mDialog;
};

/// The corner of the window around `widget` where a dialog of `size` hides the least of the canvas: its top
/// left point, on the screen.
QPoint placeBeside(const QSize& size, const QWidget& widget);

} // namespace lampblack
