// A label that ends in an ellipsis where there is no room for all of its text.
#pragma once

#include <QLabel>

namespace lampblack
{

/// Plain text, in one line. It takes any width that it is given, and its tooltip has the whole text.
class ElidedLabel : public QLabel
{
    Q_OBJECT

public:
    explicit ElidedLabel(const QString& text, QWidget* parent = nullptr);

    void setWholeText(const QString& text);
    QString shownText() const; ///< as there is room for it

protected:
    void paintEvent(QPaintEvent* event) override;
};

} // namespace lampblack
