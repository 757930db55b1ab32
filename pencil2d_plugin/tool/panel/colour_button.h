// A button that shows a colour and lets it be chosen.
#pragma once

#include <QColor>
#include <QColorDialog>
#include <QPointer>
#include <QToolButton>

namespace lampblack
{

/// While the dialog is open every choice is told at once, as one gesture; Cancel brings the colour back.
class ColourButton : public QToolButton
{
    Q_OBJECT

public:
    ColourButton(const QString& name, const QString& label, QWidget* parent = nullptr);

    QColor colour() const { return mColour; }
    /// Show a colour; tells nobody.
    void setColour(const QColor& colour);

Q_SIGNALS:
    void edited(const QColor& colour, int gesture);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void choose();

    QColor mColour = Qt::white;
    QPointer<QColorDialog> mDialog;
};

} // namespace lampblack
